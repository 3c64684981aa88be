"""Table II: parameters of the radar example, as the logs carry them."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.unknown_losses.points import swept
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"points": {"radar": ["loss=0.5"]}}
CAPTION = (
    "Table II. The parameters of the radar example as the simulation had them. sigma_m is "
    "used as a standard deviation, which its unit and Q ask for; the paper's table calls it a"
    " variance."
)


def draw(results: Results) -> Figure:
    (point,) = NEEDS["points"]["radar"]
    used = results.parameters("radar", point)
    losses = ", ".join(f"{p:g}" for p in swept(results.catalogue, "radar"))
    cells = [
        ["sampling period τ", f"{used.sampling_time:g} s", "0.01 s"],
        ["manoeuvre deviation σ$_m$", f"{used.manoeuvre_deviation:g} m/s²", "4 m/s²"],
        ["reciprocal of the manoeuvre time α", f"{used.manoeuvre_rate:g}", "1"],
        ["bearing deviation σ$_φ$", f"{np.round(used.bearing_deviation_deg, 6):g}°", "5°"],
        ["range deviation σ$_r$", f"{used.range_deviation:g} m", "5 m"],
        ["loss probability p", losses, "0.1, 0.3, 0.5, 0.7"],
    ]
    differing = [(place, 1) for place, (_, here, paper) in enumerate(cells) if here != paper]
    return style.table(cells, ("parameter", "here", "paper"), (0.42, 0.33, 0.25), differing)
