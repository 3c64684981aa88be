"""Every published value and claim of the paper with its verdict."""

from matplotlib.figure import Figure

from repro.plot.verdicts import verdicts
from repro.tables.results import Results

NEEDS = {"diff": True}
CAPTION = (
    "Verdicts of the packet-delay paper, by class of evidence. Above: published values, in "
    "standard errors of both sides. Below: every comparison behind each claim, in standard "
    "errors."
)


def draw(results: Results) -> Figure:
    return verdicts(results, "packet_delays")
