"""Figure 2: the scalar example in one run."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.energy_harvesting.compared import PROPOSED
from repro.papers.energy_harvesting.drawings import estimates
from repro.papers.energy_harvesting.shown import shown_run
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"points": {"ungm": ["base"]}}
CAPTION = (
    "Figure 2. The scalar example in the median run, by the errors of both filters: truth, "
    "PF-ROSS-EH and SPF. The title says in how many runs PF-ROSS-EH has the smaller error. "
    "figures/studies/ungm has every filter."
)
SHOWN = (PROPOSED, "spf")


def draw(results: Results) -> Figure:
    drawn, axes = style.figure(size=(style.WIDTH, 4.4))
    run = shown_run(results, "ungm", SHOWN)
    shown = estimates(results, "ungm", run.trial, SHOWN)
    for name, x in shown.items():
        k = np.arange(len(x))
        if name == "truth":
            axes.plot(k, x[:, 0], color="black", lw=1.6, label="truth")
        else:
            error = np.sqrt(((x - shown["truth"])[1:] ** 2).mean())
            label = f"{style.label(name)}, rms error {error:.2f}"
            look = style.look(results, name)
            axes.plot(k, x[:, 0], lw=1, ms=3.5, label=label, **look)
    ours, theirs = (
        (results.runs("ungm", "base", name).error[:, 1:] ** 2).mean(axis=(1, 2)) for name in SHOWN
    )
    smaller = f"{style.label(PROPOSED)} errs less in {(ours < theirs).sum()} of {len(ours)} runs"
    title = f"{run.words}; {smaller}"
    axes.set(xlabel="k", ylabel="$x_k$", title=title)
    axes.title.set_fontsize(9.5)
    drawn.legend(*axes.get_legend_handles_labels(), fontsize=8, ncols=4, loc="outside lower center")
    return drawn
