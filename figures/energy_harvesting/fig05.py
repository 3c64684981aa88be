"""Figure 5: energy level of sensor 4 and the instants at which it transmits."""

import numpy as np

from repro.papers.energy_harvesting.drawings import RUN, SENSOR, sensor_of_run
from repro.plot import style

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = "Figure 5. Energy level of sensor 4 in the first run, and when it transmits."


def draw(results):
    of = sensor_of_run(results)
    k = np.arange(len(of["y"]))
    drawn, (axes, strip) = style.figure(
        2, 1, size=(7.4, 4.0), sharex=True, gridspec_kw={"height_ratios": [3, 1]}
    )
    axes.step(k, of["energy"], where="mid", color=style.COLOURS[0], lw=1.2)
    axes.set(
        ylabel=f"$E_k^{SENSOR}$ in units", yticks=range(4), title=f"sensor {SENSOR}, run {RUN}"
    )
    strip.vlines(k[of["sent"]], 0, 1, color=style.COLOURS[2], lw=2)
    strip.set(
        xlabel="k (steps of 1 s)",
        ylabel="sent",
        yticks=[],
        title=f"{of['sent'][1:].mean():.0%} of k = 1 ... {k[-1]}",
    )
    strip.title.set_fontsize(8)
    return drawn
