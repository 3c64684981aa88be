"""One paper with its claims and figures, trimmed to few and short jobs."""

from pathlib import Path

from tests.workflow.conftest import Project

FILTERS = ("omvf", "nahi", "sun", "ekf")
TARGETS = ("into/results/diff.csv", "into/figures/packet_delays/fig01.png")
COMMAND = (*TARGETS, "--config", "trials=4", "into=into")
RESULTS = [f"into/results/**/[!.]*.{kind}" for kind in ("mcap", "npz", "csv", "md")]
RESULTS += ["into/figures/*/*.png"]


def trimmed_paper(folder: Path) -> Project:
    """A copy of the project whose `COMMAND` is some ten jobs."""
    project = Project(folder)
    project.keep_only("packet_delays", "linear_delays", ["arrival=0.5"])
    project.keep_first("packet_delays", "wsn_tracking")
    few = {"packet_bound": [2], "arrival_probability": [0.9]}
    project.keep_values("packet_delays", "wsn_tracking", **few)
    project.judge_only("packet_delays", "Table 1: ", "omvf-below-nahi")
    project.keep_filters(*FILTERS)
    return project
