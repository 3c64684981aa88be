"""Figure 5: energy level of one sensor and the instants at which it transmits."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.energy_harvesting.drawings import shown_sensor, step_label
from repro.papers.energy_harvesting.shown import shown_run
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = (
    "Figure 5. Energy level of the sensor that the paper shows, in the median run by the error "
    "of PF-ROSS-EH, and the instants at which it transmits."
)


def draw(results: Results) -> Figure:
    parameters, run = results.parameters("rss_2d", "base"), shown_run(results, "rss_2d")
    sensor = shown_sensor(results, run.trial)
    k = np.arange(len(sensor.energy))
    drawn, (axes, strip) = style.figure(
        2, 1, size=(style.WIDTH, 4.0), sharex=True, gridspec_kw={"height_ratios": [3, 1]}
    )
    axes.step(k, sensor.energy, where="mid", color=style.COLOURS[0], lw=1.2)
    axes.set(
        ylabel=f"$E_k^{sensor.number}$ in units",
        yticks=range(parameters.energy_capacity + 1),
        title=f"sensor {sensor.number}, {run.words} of PF-ROSS-EH",
    )
    strip.vlines(k[sensor.sent], 0, 1, color=style.COLOURS[2], lw=2)
    strip.set(
        xlabel=step_label(parameters),
        ylabel="sent",
        yticks=[],
        title=f"{sensor.sent[1:].mean():.0%} of k = 1 ... {k[-1]}",
    )
    strip.title.set_fontsize(8)
    return drawn
