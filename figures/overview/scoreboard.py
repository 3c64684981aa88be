"""All four papers in one picture: what reproduces, on what evidence, and how firmly."""

from matplotlib.figure import Figure

from repro.plot.scoreboard import scoreboard
from repro.tables.results import Results

NEEDS = {"diff": True}
CAPTION = (
    "A row a paper. Above: its published values and its claims by verdict. Below: what they rest "
    "on (identity, an exact equality or count; fitted, a parameter was chosen on these numbers; "
    "predicted, a test that could have failed; conditional, it could, but rests on an assumed "
    "layout or horizon), and whether the verdict is the same under every other reading of what "
    "the paper leaves open: robust, conditional (undecided under one) or reversed under one."
)


def draw(results: Results) -> Figure:
    return scoreboard(results)
