"""Figure 4: output of one sensor and the instants at which it is saturated."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.energy_harvesting.drawings import shown_sensor, step_label
from repro.papers.energy_harvesting.shown import shown_run
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = (
    "Figure 4. Output of the sensor that the paper shows, in the median run by the error of "
    "PF-ROSS-EH, and the instants at which it is saturated."
)


def draw(results: Results) -> Figure:
    parameters, run = results.parameters("rss_2d", "base"), shown_run(results, "rss_2d")
    sensor = shown_sensor(results, run.trial)
    level, output = parameters.saturation_level, sensor.output
    k = np.arange(len(output))
    drawn, axes = style.figure(size=(style.WIDTH, 3.8))
    label = f"$y_k^{sensor.number}$"
    axes.plot(k, output, ".-", color=style.COLOURS[0], lw=0.9, ms=4, label=label)
    axes.plot(
        k[sensor.saturated],
        output[sensor.saturated],
        "o",
        mfc="none",
        color=style.COLOURS[1],
        ms=8,
        label=rf"saturated ($\gamma_k=1$, $|h|>{level:g}$ dBm)",
    )
    axes.axhline(-level, color="0.5", ls=":", lw=1, label=r"$-\kappa_{\max}$")
    title = f"sensor {sensor.number}, {run.words} of PF-ROSS-EH"
    axes.set(xlabel=step_label(parameters), ylabel="output in dBm", title=title)
    axes.legend(fontsize=8)
    return drawn
