"""How many published values and claims reproduce, by paper."""

from matplotlib.figure import Figure

from repro.plot.verdicts import tally
from repro.tables.results import Results

NEEDS = {"diff": True}
CAPTION = "Published values and claims of each paper by verdict."


def draw(results: Results) -> Figure:
    return tally(results)
