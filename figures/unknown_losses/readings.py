"""Effect of the choices that the paper leaves open, on the radar at p = 0.5."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.points import PICTURED
from repro.plot import style
from repro.plot.readings import ROW, draw_readings, readings_of_point
from repro.tables.results import Results

NEEDS = {"tables": ["radar"]}
CAPTION = (
    "Position RMSE on the radar at p = 0.5 under one changed assumption at a time, with bars of "
    "two standard errors, and the median of the single runs (crosses). Beside the paper's filters "
    "the EKF that takes every value for a measurement; the fast RBPF gives the estimates of the "
    "RBPF, which runs on the base point only. figures/studies/radar has every filter."
)
BASE = "loss=0.5"


def draw(results: Results) -> Figure:
    rows = len(readings_of_point(results, "radar", BASE))
    drawn, axes = style.figure(size=(style.WIDTH, 1.3 * ROW * rows + 1.2))
    filters = (*PICTURED["radar"], "rbpf_fast", "ekf")
    draw_readings(axes, results, "radar", BASE, "rmse", "position", filters, "p = 0.5")
    axes.set_xlabel("position RMSE in m, mean over the steps")
    drawn.legend(*axes.get_legend_handles_labels(), fontsize=8, ncols=4, loc="outside lower center")
    return drawn
