"""Figure 2: the scalar example in one run."""

import numpy as np

from repro.papers.energy_harvesting.drawings import RUN, estimates
from repro.plot import style

NEEDS = {"points": {"ungm": ["base"]}}
CAPTION = (
    "Figure 2. The scalar example, the first run, not a chosen one: truth, PF-ROSS-EH and SPF. The "
    "title says in how many runs PF-ROSS-EH errs less."
)


def draw(results):
    drawn, axes = style.figure(size=(7.4, 4.2))
    shown = estimates(results, "ungm")
    for name, x in shown.items():
        k = np.arange(len(x))
        if name == "truth":
            axes.plot(k, x[:, 0], color="black", lw=1.6, label="truth")
        else:
            error = np.sqrt(((x - shown["truth"])[1:] ** 2).mean())
            label = f"{style.label(name)}, rms error {error:.2f}"
            look = style.look(results.catalogue, "ungm", name)
            axes.plot(k, x[:, 0], lw=1, ms=3.5, label=label, **look)
    ours, theirs = (
        (results.runs("ungm", "base", name).error[:, 1:] ** 2).mean(axis=(1, 2))
        for name in ("pf_ross_eh", "spf")
    )
    title = f"run {RUN}; PF-ROSS-EH errs less in {(ours < theirs).sum()} of {len(ours)} runs"
    axes.set(xlabel="k", ylabel="$x_k$", title=title)
    axes.legend(fontsize=8, ncols=3, loc="upper center")
    axes.set_ylim(top=29)
    return drawn
