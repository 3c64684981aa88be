"""One paper with its claims and figures, trimmed to few and short jobs."""

from pathlib import Path

from tests.workflow.conftest import Project, trimmed_paper

TARGETS = ("into/results/diff.csv", "into/figures/packet_delays/fig01.png")
COMMAND = (*TARGETS, "--config", "trials=4", "into=into")
RESULTS = [f"into/results/**/[!.]*.{kind}" for kind in ("mcap", "npz", "csv", "md")]
RESULTS += ["into/figures/*/*.png"]


def smallest_paper(folder: Path) -> Project:
    """A copy of the project whose `COMMAND` is some ten jobs."""
    return trimmed_paper(folder, points=["arrival=0.5"])
