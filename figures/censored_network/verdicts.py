"""Every published value and claim of the paper with its verdict."""

from matplotlib.figure import Figure

from repro.plot.verdicts import verdicts
from repro.tables.results import Results

NEEDS = {"diff": True}
CAPTION = (
    "Verdicts of censored_network. Left: our values over the published ones, with the standard "
    "errors of both. Right: every comparison behind each claim, in standard errors."
)


def draw(results: Results) -> Figure:
    return verdicts(results, "censored_network")
