"""Figure 2: the scalar example in one run."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.energy_harvesting.compared import PROPOSED
from repro.papers.energy_harvesting.drawings import estimates, shown_run
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"points": {"ungm": ["base"]}}
CAPTION = (
    "Figure 2. The scalar example in one run, not a selected one: truth, PF-ROSS-EH and SPF. The "
    "title says in how many runs PF-ROSS-EH has the smaller error. figures/studies/ungm has every "
    "filter."
)
SHOWN = (PROPOSED, "spf")


def draw(results: Results) -> Figure:
    drawn, axes = style.figure(size=(7.4, 4.2))
    shown = estimates(results, "ungm", SHOWN)
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
    title = f"run {shown_run(results, 'ungm')}; {smaller}"
    axes.set(xlabel="k", ylabel="$x_k$", title=title)
    axes.legend(fontsize=8, ncols=3, loc="upper center")
    axes.set_ylim(top=29)
    return drawn
