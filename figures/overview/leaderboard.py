"""How the filters of every study rank, relative to the reference that knows most."""

from matplotlib.figure import Figure

from repro.plot.leaderboard import leaderboard
from repro.tables.results import Results

NEEDS = {"leaderboard": True}
CAPTION = (
    "Error of each filter relative to the reference that knows most (where a study has none, to "
    "the best of the paper's filters) on the points of the study's first family: dots are the "
    "geometric mean over the points, lines the range. A cross compares the medians of the single "
    "runs, which a few runs that lost their target do not move. Left of 1 is better; what is off "
    "the scale is an arrow at its edge. Every point: results/leaderboard.csv."
)


def draw(results: Results) -> Figure:
    return leaderboard(results)
