"""Figure 1: the two censoring models."""

import numpy as np
from matplotlib.figure import Figure

from repro.network.censoring import censored
from repro.plot import style
from repro.studies.deadband import STUDY
from repro.tables.results import Results

NEEDS = {"points": {"deadband": ["base"], "saturation": ["base"]}}
CAPTION = (
    "Redrawing of Fig. 1: received against ideal reading: dead band (4), purple, solid, and "
    "saturation (5), blue, dotted, with the thresholds of Sec. IV. Points are the readings of "
    "target 1 in the first run."
)
RANGE = (-35, 20)  # dB
LOOKS = (
    ("deadband", "dead band (4)", {"color": "purple", "ls": "-", "lw": 1.8}),
    ("saturation", "saturation (5)", {"color": "blue", "ls": ":", "lw": 2.4}),
)


def draw(results: Results) -> Figure:
    drawn, axes = style.figure(size=(5.8, 5.0))
    ideal = np.linspace(*RANGE, 2201)
    for study, name, look in LOOKS:
        log = results.log(study, "base")
        known = STUDY.model(log.parameters)
        received, _ = censored(ideal, known.censoring)
        jumps = np.flatnonzero(np.abs(np.diff(received)) > 1) + 1  # not joined by a line
        axes.plot(
            np.insert(ideal, jumps, np.nan), np.insert(received, jumps, np.nan), **look, label=name
        )
        for threshold in (log.parameters.lower_threshold, log.parameters.upper_threshold):
            axes.axvline(threshold, color=look["color"], lw=0.8, ls="--", alpha=0.6)
        groups, size, _ = known.sensors.shape
        simulated = log.values["/sensor"][0, 1:, : groups * size].ravel()
        axes.plot(
            simulated,
            censored(simulated, known.censoring)[0],
            ".",
            color=look["color"],
            ms=3,
            alpha=0.5,
        )
    axes.set(
        xlabel="ideal reading in dB",
        ylabel="received reading in dB",
        xlim=RANGE,
        ylim=RANGE,
    )
    axes.plot([], [], color="0.4", lw=0.8, ls="--", label="its thresholds")
    axes.legend(fontsize=8.5)
    return drawn
