"""Every published value and claim of the paper with its verdict."""

from matplotlib.figure import Figure

from repro.plot.verdicts import verdicts
from repro.tables.results import Results

NEEDS = {"diff": True}
CAPTION = (
    "Verdicts of the unknown-losses paper. Left: ours over published, with the standard "
    "errors of both. Right: every comparison that a claim consists of, in standard errors."
)


def draw(results: Results) -> Figure:
    return verdicts(results, "unknown_losses")
