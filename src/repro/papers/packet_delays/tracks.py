"""Figures 3-10 of Liu, Xu, Shi 2012: one run in the field, and its error over k."""

from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from repro.plot import style
from repro.studies import wsn_tracking
from repro.tables.results import Results

STUDY = "wsn_tracking"
MARGIN = 15  # m drawn round the field


class Curve(NamedTuple):
    label: str
    point: str
    filter: str
    look: dict


def curves(results: Results, p: str, ekf: bool) -> list[Curve]:
    """EMVF with N = 1 and N = 2, and each other filter once; the EKF where the paper draws it."""
    drawn = []
    for filter_ in results.filters(STUDY, f"n1-arrival={p}"):
        look = style.look(results.catalogue, STUDY, filter_)
        if filter_ == "emvf":
            drawn.append(Curve("EMVF, N = 1", f"n1-arrival={p}", filter_, look))
            second = look | {"color": style.COLOURS[3], "marker": "s"}
            drawn.append(Curve("EMVF, N = 2", f"n2-arrival={p}", filter_, second))
        elif filter_ != "ekf" or ekf:
            drawn.append(Curve(style.label(filter_), f"n1-arrival={p}", filter_, look))
    return drawn


def missed_steps(results: Results, p: str) -> np.ndarray:
    """Steps whose packet is late or lost, (trials, steps + 1); the same for N = 1 and N = 2."""
    return results.log(STUDY, f"n1-arrival={p}").field("/network", "gamma_0") == 0


def first_trial(condition: np.ndarray) -> int:
    """The first trial that shows the packet pattern the paper describes; 0 if none does."""
    return int(condition.argmax())


def trajectories(results: Results, p: str, trial: int, ekf: bool) -> Figure:
    """One panel a filter: field, sensors, tasked sensors, true and estimated positions, links."""
    shown = curves(results, p, ekf)
    columns = min(len(shown), 2)
    rows = -(-len(shown) // columns)
    drawn, grid = style.figure(rows, columns, size=(3.9 * columns, 3.9 * rows), squeeze=False)
    for axes in grid.flat[len(shown) :]:
        axes.remove()
    for axes, curve in zip(grid.flat, shown, strict=False):
        log = results.log(STUDY, curve.point)
        runs = results.runs(STUDY, curve.point, curve.filter)
        truth = log.values["/truth"][trial]
        estimate = truth + runs.error[trial]
        sensors = wsn_tracking.positions(log)[trial]
        tasked = sensors[runs.recorded["tasked"][trial]]
        links = np.stack([estimate[:, :2], tasked], axis=1)
        axes.plot(*links.transpose(2, 1, 0), color="#0072B2", lw=0.4, alpha=0.6)
        axes.plot(*truth[:, :2].T, color="black", lw=1.2, label="true")
        axes.plot(
            *estimate[:, :2].T,
            color=curve.look["color"],
            marker=".",
            ms=4,
            lw=0.8,
            label="estimate",
        )
        axes.plot(*sensors.T, "o", mfc="none", color="0.4", ms=5, label="sensor")
        axes.plot(*tasked.T, "*", color="#E69F00", ms=7, label="tasked sensor")
        worst = np.hypot(*runs.error[trial, 1:, :2].T).max()
        axes.set(
            title=f"{curve.label}: largest error {worst:.3g} m",
            xlabel="x in m",
            ylabel="y in m",
            xlim=(-MARGIN, 100 + MARGIN),
            ylim=(-MARGIN, 100 + MARGIN),
            aspect="equal",
        )
        axes.title.set_fontsize(9)
    grid.flat[0].legend(fontsize=7, loc="lower left")
    drawn.suptitle(f"p = {p}, run {trial}", fontsize=10)
    return drawn


def error_over_k(
    results: Results, p: str, trial: int, ekf: bool, published: dict[str, tuple[float, float]]
) -> Figure:
    """Er(k) of one run, the 10-90 % band over all runs, and which packets come on time.

    `published` maps a label to the range of error in m that the paper names.
    """
    drawn, (axes, strip) = style.figure(
        2, 1, size=(7.2, 5.0), sharex=True, gridspec_kw={"height_ratios": [6, 1]}
    )
    table = results.curves(STUDY)
    for curve in curves(results, p, ekf):
        error = wsn_tracking.position_error(results.runs(STUDY, curve.point, curve.filter))[trial]
        steps = np.arange(1, len(error))
        rows = table[(table["point"] == curve.point) & (table["filter"] == curve.filter)]
        rows = rows[rows["k"] > 0]
        axes.plot(steps, error[1:], ms=3, lw=1.2, label=curve.label, **curve.look)
        axes.fill_between(
            rows["k"], rows["q10"], rows["q90"], color=curve.look["color"], alpha=0.13, lw=0
        )
    for name, (low, high) in published.items():
        axes.axhline(high, color="black", lw=1, ls=":")
        axes.axhline(low, color="black", lw=1, ls=":")
        axes.annotate(
            name,
            (1, low),
            fontsize=8,
            va="top",
            xytext=(0, -2),
            textcoords="offset points",
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.5},
            zorder=5,
        )
    axes.set(
        yscale="log",
        ylim=(5e-4, None),
        ylabel="position error Er(k) in m",
        title=f"p = {p}: lines are run {trial}, bands 10 to 90 % of all runs",
    )
    axes.legend(fontsize=8, ncols=2)
    gamma = ~missed_steps(results, p)[trial, 1:]
    strip.step(np.arange(1, len(gamma) + 1), gamma, where="mid", color="black", lw=1)
    strip.set(xlabel="k (steps of 0.1 s)", ylabel=r"$\gamma_0(k)$", yticks=[0, 1], ylim=(-0.2, 1.2))
    return drawn
