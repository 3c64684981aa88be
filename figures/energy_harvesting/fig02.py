"""Figure 2: the scalar example in one run."""

import numpy as np

from repro.plot import style
from repro.plot.energy_harvesting import RUN, estimates

NEEDS = {"points": {"ungm": ["base"]}}
CAPTION = "Figure 2. The scalar example, the first run: truth, PF-ROSS-EH and SPF."


def draw(results):
    drawn, axes = style.figure(size=(7.4, 4.2))
    for name, x in estimates(results, "ungm").items():
        k = np.arange(len(x))
        if name == "truth":
            axes.plot(k, x[:, 0], color="black", lw=1.6, label="truth")
        else:
            error = np.sqrt(((x - estimates(results, "ungm")["truth"])[1:] ** 2).mean())
            label = f"{style.label(name)}, rms error {error:.2f}"
            look = style.look(results.catalogue, "ungm", name)
            axes.plot(k, x[:, 0], lw=1, ms=3.5, label=label, **look)
    axes.set(xlabel="k", ylabel="$x_k$", title=f"run {RUN}")
    axes.legend(fontsize=8)
    return drawn
