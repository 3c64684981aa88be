"""One run in the field, and its error over k [packet_delays Figs. 3-10]."""

from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from repro.papers.packet_delays.points import (
    FIGURES_3_6,
    FIGURES_7_10,
    TRACKING,
    missed_packets,
    tracking_point,
)
from repro.plot import style
from repro.statistics.runs import Runs
from repro.studies import wsn_tracking
from repro.tables.results import Results

MARGIN = 15  # m drawn round the field


class Curve(NamedTuple):
    """What is drawn of one filter."""

    label: str
    point: str
    filter: str
    look: dict


def curves(results: Results, arrival: str, ekf: bool) -> list[Curve]:
    """EMVF and a reader's own filters with N = 1 and N = 2, the others with N = 1.

    The EKF is drawn where the paper draws it.
    """
    drawn = []
    for bound, other in ((1, {}), (2, {"linestyle": "--"})):
        point = tracking_point(bound, arrival)
        for filter_ in results.and_own(TRACKING, point, FIGURES_3_6 if ekf else FIGURES_7_10):
            look, label = style.look(results, filter_) | other, style.label(filter_)
            if filter_ == "emvf" and bound == 2:
                look = style.look(results, filter_) | {"color": style.COLOURS[3], "marker": "s"}
            if filter_ == "emvf" or filter_ in results.own_filters:
                drawn.append(Curve(f"{label}, N = {bound}", point, filter_, look))
            elif bound == 1:
                drawn.append(Curve(label, point, filter_, look))
    return sorted(drawn, key=lambda curve: curve.filter != "emvf")  # its two side by side


def missed_steps(results: Results, arrival: str) -> np.ndarray:
    """Whether the packet of k = 1, 2, ... is late or lost, (trials, steps); N = 1 and 2 agree."""
    return missed_packets(results.log(TRACKING, tracking_point(1, arrival)))


def run_missing(results: Results, arrival: str, number: int) -> int:
    """The first run that misses this number of packets; 0 if none does."""
    return int((missed_steps(results, arrival).sum(axis=1) == number).argmax())


def run_missing_step(results: Results, arrival: str, k: int) -> int:
    """The first run that misses the packet of step k and no other; 0 if none does."""
    missed = missed_steps(results, arrival)
    return int(((missed.sum(axis=1) == 1) & missed[:, k - 1]).argmax())


def run_of_figure_6(results: Results, arrival: str) -> int:
    """The first run that misses the packet of the step that the paper names, and no other."""
    return run_missing_step(results, arrival, results.analysis(TRACKING).figure_6_missed_step)


def run_of_figure_8(results: Results, arrival: str) -> int:
    """The first run that misses as many packets as a run does on average, rounded."""
    parameters = results.parameters(TRACKING, tracking_point(1, arrival))
    mean = parameters.steps * (1 - parameters.arrival_probability)
    return run_missing(results, arrival, round(mean))


def run_of_figure_10(results: Results, arrival: str) -> int:
    """The first run that misses as many packets as the one that the paper shows."""
    return run_missing(results, arrival, results.analysis(TRACKING).figure_10_missed_packets)


def _largest_error(runs: Runs, trial: int) -> float:
    return wsn_tracking.position_error(runs)[trial, 1:].max()


def trajectories(results: Results, arrival: str, trial: int, ekf: bool) -> Figure:
    """One panel a filter: field, sensors, tasked sensors, true and estimated positions, links."""
    shown = curves(results, arrival, ekf)
    side = results.parameters(TRACKING, shown[0].point).field_side
    columns = min(len(shown), 2)
    rows = -(-len(shown) // columns)
    drawn, grid = style.figure(rows, columns, size=(3.9 * columns, 3.9 * rows), squeeze=False)
    for axes in grid.flat[len(shown) :]:
        axes.remove()
    for axes, curve in zip(grid.flat, shown, strict=False):
        log = results.log(TRACKING, curve.point)
        runs = results.runs(TRACKING, curve.point, curve.filter)
        truth = log.values["/truth"][trial]
        estimate = truth + runs.error[trial]
        sensors = wsn_tracking.positions(log)[trial]
        tasked = sensors[runs.recorded["tasked"][trial]]
        links = np.stack([estimate[:, :2], tasked], axis=1)
        axes.plot(*links.transpose(2, 1, 0), color=style.COLOURS[0], lw=0.4, alpha=0.6)
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
        axes.plot(*tasked.T, "*", color=style.COLOURS[4], ms=7, label="tasked sensor")
        axes.set(
            title=f"{curve.label}: largest error {_largest_error(runs, trial):.3g} m",
            xlabel="x in m",
            ylabel="y in m",
            xlim=(-MARGIN, side + MARGIN),
            ylim=(-MARGIN, side + MARGIN),
            aspect="equal",
        )
        axes.title.set_fontsize(9)
    grid.flat[0].legend(fontsize=7, loc="lower left")
    drawn.suptitle(f"p = {arrival}, run {trial}", fontsize=10)
    return drawn


def error_over_k(
    results: Results,
    arrival: str,
    trial: int,
    ekf: bool,
    published: dict[str, tuple[float, float]] | None = None,
) -> Figure:
    """Er(k) of one run, the 10-90 % band over all runs, and which packets come on time.

    `published` maps a label to the range of error in m that the paper names.
    """
    drawn, (axes, strip) = style.figure(
        2, 1, size=(7.2, 5.0), sharex=True, gridspec_kw={"height_ratios": [6, 1]}
    )
    shown = curves(results, arrival, ekf)
    table = results.curves(TRACKING)
    for curve in shown:
        runs = results.runs(TRACKING, curve.point, curve.filter)
        error = wsn_tracking.position_error(runs)[trial]
        steps = np.arange(1, len(error))
        rows = table[(table["point"] == curve.point) & (table["filter"] == curve.filter)]
        rows = rows[rows["k"] > 0]
        axes.plot(steps, error[1:], ms=3, lw=1.2, label=curve.label, **curve.look)
        axes.fill_between(
            rows["k"], rows["q10"], rows["q90"], color=curve.look["color"], alpha=0.13, lw=0
        )
    for name, (low, high) in (published or {}).items():
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
        title=f"p = {arrival}: lines are run {trial}, bands 10 to 90 % of all runs",
    )
    axes.legend(fontsize=8, ncols=2)
    on_time = ~missed_steps(results, arrival)[trial]
    time = results.parameters(TRACKING, shown[0].point).sampling_time
    strip.step(np.arange(1, len(on_time) + 1), on_time, where="mid", color="black", lw=1)
    strip.set(
        xlabel=f"k (steps of {time} s)",
        ylabel=r"$\gamma_0(k)$",
        yticks=[0, 1],
        ylim=(-0.2, 1.2),
    )
    return drawn


def printed_small_error(results: Results) -> dict[str, tuple[float, float]]:
    """The bound of the errors in Fig. 4, for `error_over_k`."""
    bound = results.analysis(TRACKING).small_error
    return {f"Fig. 4: below {bound:g} m": (bound, bound)}


def printed_largest_errors(results: Results) -> dict[str, tuple[float, float]]:
    """The largest errors in Fig. 10, for `error_over_k`."""
    labels = {}
    for bound, (low, high) in results.analysis(TRACKING).figure_10_largest_errors.items():
        printed = f"{low:g} m" if low == high else f"{low:g} to {high:g} m"
        labels[f"Fig. 10, N = {bound}: {printed}"] = (low, high)
    return labels
