"""Figure 4: output of sensor 4 and the instants at which it is saturated."""

import numpy as np

from repro.papers.energy_harvesting.drawings import RUN, SENSOR, sensor_of_run
from repro.plot import style

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = "Figure 4. Output of sensor 4 in the first run, and where it is saturated."


def draw(results):
    of = sensor_of_run(results)
    k = np.arange(len(of["y"]))
    drawn, axes = style.figure(size=(7.4, 3.8))
    axes.plot(k, of["y"], ".-", color=style.COLOURS[0], lw=0.9, ms=4, label=f"$y_k^{SENSOR}$")
    axes.plot(
        k[of["saturated"]],
        of["y"][of["saturated"]],
        "o",
        mfc="none",
        color=style.COLOURS[1],
        ms=8,
        label=r"saturated ($\gamma_k=1$, $|h|>30$ dBm)",
    )
    axes.axhline(-30, color="0.5", ls=":", lw=1, label=r"$-\kappa_{\max}$")
    axes.set(xlabel="k (steps of 1 s)", ylabel="output in dBm", title=f"sensor {SENSOR}, run {RUN}")
    axes.legend(fontsize=8)
    return drawn
