"""Figure 3: true and estimated track in the plane, one run."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.drawings import estimates
from repro.papers.energy_harvesting.shown import shown_run
from repro.plot import style
from repro.studies.families import signal_strength
from repro.tables.results import Results

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = (
    "Figure 3. The track in the plane and its estimate in the median run, by its "
    "error. figures/studies/rss_2d has every filter."
)


def draw(results: Results) -> Figure:
    run = shown_run(results, "rss_2d")
    drawn, axes = style.figure(size=(5.6, 5.4))
    for name, x in estimates(results, "rss_2d", run.trial).items():
        if name == "truth":
            axes.plot(x[:, 0], x[:, 2], color="black", lw=1.8, label="truth")
            axes.plot(x[0, 0], x[0, 2], "o", color="black", ms=6, label="start")
        else:
            look = style.look(results, name)
            axes.plot(x[1:, 0], x[1:, 2], lw=0.9, ms=3, label=style.label(name), **look)
    sensors = signal_strength.positions(results.parameters("rss_2d", "base"))
    for i, (x, y) in enumerate(sensors, start=1):
        axes.plot(x, y, "^", color="0.4", ms=8, label="sensor" if i == 1 else None)
        axes.annotate(str(i), (x, y), xytext=(6, 5), textcoords="offset points", fontsize=9)
    axes.set(
        xlabel="x in m",
        ylabel="y in m",
        aspect="equal",
        title=run.words,
    )
    drawn.legend(*axes.get_legend_handles_labels(), fontsize=8, ncols=4, loc="outside lower center")
    return drawn
