"""One run in the field, and its error over k [packet_delays Figs. 3-10]."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.papers.packet_delays.claims.errors import largest_error
from repro.papers.packet_delays.points import (
    FIGURES_3_6,
    FIGURES_7_10,
    TRACKING,
    missed_packets,
    tracking_point,
)
from repro.plot import looks, style
from repro.statistics.typical_run import TypicalRun, typical_run
from repro.studies import wsn_tracking
from repro.tables.results import Results

MARGIN = 15  # m drawn round the field
NUMBERS = {3: "three", 4: "four"}


class Curve(NamedTuple):
    """What is drawn of one filter."""

    label: str
    point: str
    filter: str
    look: dict


def curves(results: Results, arrival: str, ekf: bool) -> list[Curve]:
    """EMVF and a reader's own filters with N = 1 and N = 2, the others with N = 1.

    The EKF is drawn where the paper draws it. N = 2 is the darker shade of the filter's colour.
    """
    drawn = []
    for bound in (1, 2):
        point = tracking_point(bound, arrival)
        for filter_ in results.and_own(TRACKING, point, FIGURES_3_6 if ekf else FIGURES_7_10):
            look, label = style.look(results, filter_), style.label(filter_)
            if filter_ == "emvf" or filter_ in results.own_filters:
                shade = looks.shades(look["color"], 2)[bound - 1]
                name = f"{label}, N = {bound}"
                drawn.append(Curve(name, point, filter_, look | {"color": shade}))
            elif bound == 1:
                drawn.append(Curve(label, point, filter_, look))
    return sorted(drawn, key=lambda curve: curve.filter != "emvf")  # its two side by side


def missed_steps(results: Results, arrival: str) -> np.ndarray:
    """Whether the packet of k = 1, 2, ... is late or lost, (trials, steps); N = 1 and 2 agree."""
    return missed_packets(results.log(TRACKING, tracking_point(1, arrival)))


def run_missing(results: Results, arrival: str, number: int, ekf: bool) -> TypicalRun:
    """The typical run of those that miss this number of packets."""
    return _typical(results, arrival, missed_steps(results, arrival).sum(axis=1) == number, ekf)


def run_of_figure_6(results: Results, arrival: str) -> TypicalRun:
    """The typical run of those that miss the packet that the paper names, and no other."""
    missed = missed_steps(results, arrival)
    k = results.analysis(TRACKING).figure_6_missed_step
    return _typical(results, arrival, (missed.sum(axis=1) == 1) & missed[:, k - 1], ekf=True)


def run_of_figure_8(results: Results, arrival: str) -> TypicalRun:
    """The typical run of those that miss as many packets as a run does on average, rounded."""
    parameters = results.parameters(TRACKING, tracking_point(1, arrival))
    mean = parameters.steps * (1 - parameters.arrival_probability)
    return run_missing(results, arrival, round(mean), ekf=False)


def run_of_figure_10(results: Results, arrival: str) -> TypicalRun:
    """The typical run of those that miss as many packets as the one that the paper shows."""
    number = results.analysis(TRACKING).figure_10_missed_packets
    return run_missing(results, arrival, number, ekf=False)


def _typical(results: Results, arrival: str, qualifies: np.ndarray, ekf: bool) -> TypicalRun:
    """By the largest error of each curve but a reader's own, which must not change the run."""
    compared = [(1, "emvf"), (2, "emvf"), (1, "iekf"), *([(1, "ekf")] if ekf else [])]
    errors = [largest_error(results, bound, arrival, filter_) for bound, filter_ in compared]
    return typical_run(errors, qualifies)


def trajectories(results: Results, arrival: str, run: TypicalRun, ekf: bool) -> Figure:
    """One panel a filter: field, sensors, tasked sensors, true and estimated positions, links."""
    shown = curves(results, arrival, ekf)
    side = results.parameters(TRACKING, shown[0].point).field_side
    columns = 3 if len(shown) % 3 == 0 else 2
    rows = -(-len(shown) // columns)
    drawn, grid = style.figure(
        rows,
        columns,
        size=(style.WIDTH, (style.WIDTH / columns + 0.2) * rows + 1.0),
        squeeze=False,
        sharex=True,
        sharey=True,
    )
    for axes in grid.flat[len(shown) :]:
        axes.remove()
    for axes, curve in zip(grid.flat, shown, strict=False):
        log = results.log(TRACKING, curve.point)
        runs = results.runs(TRACKING, curve.point, curve.filter)
        truth = log.values["/truth"][run.trial]
        estimate = truth + runs.error[run.trial]
        sensors = wsn_tracking.positions(log)[run.trial]
        tasked = sensors[runs.recorded["tasked"][run.trial]]
        links = np.stack([estimate[:, :2], tasked], axis=1)
        axes.plot(*links.transpose(2, 1, 0), color="0.75", lw=0.5, zorder=1)
        axes.plot(*truth[:, :2].T, color="black", lw=1.2, label="true")
        look = {"color": curve.look["color"], "marker": ".", "ms": 4, "lw": 0.8}
        axes.plot(*estimate[:, :2].T, **look, label=curve.label)
        axes.plot(*sensors.T, "o", mfc="white", color="0.4", ms=5)
        axes.plot(*tasked.T, "*", color=style.COLOURS[4], mec="black", mew=0.4, ms=8)
        largest = wsn_tracking.position_error(runs)[run.trial, 1:].max()
        axes.set(
            title=f"{curve.label}:\nlargest error {largest:.3g} m",
            xlim=(-MARGIN, side + MARGIN),
            ylim=(-MARGIN, side + MARGIN),
            aspect="equal",
        )
        axes.title.set_fontsize(9)
        axes.set(xlabel="x in m", ylabel="y in m")
        axes.label_outer()
    _track_legend(drawn, grid.flat[0])
    drawn.suptitle(f"p = {arrival}: {run.words}", fontsize=10)
    return drawn


def _track_legend(drawn: Figure, axes: Axes) -> None:
    """Below the panels, where it hides no sensor."""
    handles = [
        *axes.plot([], [], color="black", lw=1.2, label="true"),
        *axes.plot([], [], ".-", color="0.3", lw=0.8, label="estimate (in the filter's colour)"),
        *axes.plot([], [], "o", mfc="white", color="0.4", ms=5, label="sensor"),
        *axes.plot([], [], "*", color=style.COLOURS[4], mec="black", mew=0.4, ms=8, label="tasked"),
        *axes.plot([], [], color="0.75", lw=0.8, label="estimate to its tasked sensor"),
    ]
    drawn.legend(handles=handles, fontsize=8, ncols=5, loc="outside lower center")


def error_over_k(
    results: Results,
    arrival: str,
    run: TypicalRun,
    ekf: bool,
    published: dict[str, tuple[float, float]] | None = None,
) -> Figure:
    """Er(k) of one run, the 10-90 % band over all runs, and which packets come on time.

    `published` maps a label to the range of error in m that the paper names.
    """
    drawn, (axes, strip) = style.figure(
        2, 1, size=(style.WIDTH, 5.6), sharex=True, gridspec_kw={"height_ratios": [6, 1]}
    )
    shown = curves(results, arrival, ekf)
    table = results.curves(TRACKING)
    errors = []
    for curve in shown:
        runs = results.runs(TRACKING, curve.point, curve.filter)
        errors.append(wsn_tracking.position_error(runs)[run.trial, 1:])
        steps = np.arange(1, len(errors[-1]) + 1)
        rows = table[(table["point"] == curve.point) & (table["filter"] == curve.filter)]
        rows = rows[rows["k"] > 0]
        axes.plot(steps, errors[-1], ms=3, lw=1.2, label=curve.label, **curve.look)
        axes.fill_between(
            rows["k"], rows["q10"], rows["q90"], color=curve.look["color"], alpha=0.13, lw=0
        )
    lowest, highest = np.min(errors), np.max(errors)
    lines = ((":", "black"), ("--", "0.4"))
    for (name, (low, high)), (dashes, colour) in zip(
        (published or {}).items(), lines, strict=False
    ):
        for edge, label in {low: name, high: name if low == high else None}.items():
            axes.axhline(edge, color=colour, lw=1.2, ls=dashes, label=label)
        highest = max(highest, high)
    if np.allclose(errors, errors[0], rtol=1e-6):
        axes.plot([], [], " ", label=f"all {NUMBERS.get(len(shown), len(shown))} coincide")
    # A filter that loses the target in other runs takes its band out of the picture.
    axes.set(
        yscale="log",
        ylim=(max(lowest / 2, 5e-4), 5 * highest),
        ylabel="position error Er(k) in m",
        title=f"p = {arrival}: lines are {run.words};\nbands 10 to 90 % of all "
        f"{int(results.in_shards(TRACKING, shown[0].point, shown[0].filter).trials)} runs",
    )
    axes.title.set_fontsize(10)
    drawn.legend(*axes.get_legend_handles_labels(), fontsize=8, ncols=3, loc="outside lower center")
    on_time = ~missed_steps(results, arrival)[run.trial]
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
