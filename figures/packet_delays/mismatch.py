"""Errors of filters that take a parameter of the network for another than it is."""

from matplotlib.figure import Figure

from repro.plot.mismatch import mismatch
from repro.tables.results import Results

NEEDS = {"mismatch": ["linear_delays", "wsn_tracking"]}
CAPTION = (
    "Error of filters that assume a wrong value, relative to that with the right one, which the "
    "dotted vertical line marks; on the same trials. Bands and bars: two standard errors; dotted "
    "curves: of the median run."
)


def draw(results: Results) -> Figure:
    return mismatch(results, NEEDS["mismatch"])
