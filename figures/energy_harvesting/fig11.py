"""Figure 11: true and estimated track in space, one run."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.drawings import estimates
from repro.papers.energy_harvesting.shown import shown_run
from repro.plot import style
from repro.studies.families import signal_strength
from repro.tables.results import Results

NEEDS = {"points": {"rss_3d": ["base"]}}
CAPTION = (
    "Figure 11. The track in space and its estimate in the median run, by its "
    "error. figures/studies/rss_3d has every filter."
)


def draw(results: Results) -> Figure:
    run = shown_run(results, "rss_3d")
    drawn, axes = style.figure(size=(6.4, 5.6), subplot_kw={"projection": "3d"})
    for name, x in estimates(results, "rss_3d", run.trial).items():
        if name == "truth":
            axes.plot(x[:, 0], x[:, 2], x[:, 4], color="black", lw=1.8, label="truth")
            axes.plot(*x[:1, ::2].T, "o", color="black", ms=6, label="start")
        else:
            look = style.look(results, name)
            axes.plot(x[1:, 0], x[1:, 2], x[1:, 4], lw=0.9, ms=3, label=style.label(name), **look)
    sensors = signal_strength.positions(results.parameters("rss_3d", "base"))
    axes.scatter(*zip(*sensors, strict=True), marker="^", color="0.4", s=45, label="sensor")
    axes.set(
        xlabel="x in m",
        ylabel="y in m",
        zlabel="z in m",
        title=run.words,
    )
    axes.set_box_aspect(None, zoom=0.88)
    drawn.legend(*axes.get_legend_handles_labels(), fontsize=8, ncols=4, loc="outside lower center")
    return drawn
