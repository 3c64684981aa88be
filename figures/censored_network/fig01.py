"""Figure 1: the two censoring models."""

import numpy as np

from repro.network.censoring import Censoring, censored
from repro.plot import style

NEEDS = {"points": {"deadband": ["base"], "saturation": ["base"]}}
CAPTION = (
    "Figure 1. Received against ideal reading: dead band (4), purple, solid, and saturation "
    "(5), blue, dotted, with the thresholds of Sec. IV. Points are the readings of target 1 "
    "in the first run."
)
LOOKS = (
    ("deadband", "dead band (4)", {"color": "purple", "ls": "-", "lw": 1.8}),
    ("saturation", "saturation (5)", {"color": "blue", "ls": ":", "lw": 2.4}),
)


def draw(results):
    drawn, axes = style.figure(size=(5.6, 4.6))
    ideal = np.linspace(-35, 20, 2201)
    for study, name, look in LOOKS:
        log = results.log(study, "base")
        model = Censoring(
            log.parameters.censoring,
            log.parameters.lower_threshold,
            log.parameters.upper_threshold,
            log.parameters.dead_band_constant,
        )
        received, _ = censored(ideal, model)
        jumps = np.flatnonzero(np.abs(np.diff(received)) > 1) + 1  # not joined by a line
        axes.plot(
            np.insert(ideal, jumps, np.nan), np.insert(received, jumps, np.nan), **look, label=name
        )
        simulated = log.values["/sensor"][0, 1:, :6].ravel()
        axes.plot(
            simulated, censored(simulated, model)[0], ".", color=look["color"], ms=3, alpha=0.5
        )
    axes.set(
        xlabel="ideal reading in dB",
        ylabel="received reading in dB",
        xlim=(-35, 20),
        ylim=(-35, 20),
    )
    axes.legend()
    return drawn
