"""[unknown_losses Figs. 8-10]: flights on the filters' estimates."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.papers.unknown_losses.points import PICTURED
from repro.plot import style
from repro.statistics.typical_run import TypicalRun, typical_run
from repro.studies import quadrotor
from repro.tables.results import Results

STUDY = "quadrotor"
NAMES = {"ekf_no_loss": "EKF (no losses)", "iekf": "IEKF (losses known)", "rbpf_fast": "RBPF"}
BELOW = "iekf"  # whose flight the others are compared with


def _name(filter_: str) -> str:
    return NAMES.get(filter_, style.label(filter_))


def _lines(results: Results, point: str) -> dict[str, dict[str, Any]]:
    """Looks of the filters of Figs. 8 and 9, whose flights lie on each other; the IEKF's is below.

    A reader's own filters come last.
    """
    wanted = sorted(PICTURED[STUDY], key=lambda name: name != BELOW)
    names = results.and_own(STUDY, point, wanted)
    return {
        name: {"color": style.look(results, name)["color"]} | style.interlaced(place, len(names))
        for place, name in enumerate(names)
    }


def shown_flight(results: Results, point: str, filter_: str) -> TypicalRun:
    """The flight whose rms distance to the reference is the median of all flights."""
    return typical_run([quadrotor.squared_distance(results.runs(STUDY, point, filter_))])


def _deviation(results: Results, point: str, filter_: str, flight: int) -> np.ndarray:
    """Position of a flight less that of the flight on the IEKF, (steps + 1, 3)."""
    own, known = (
        results.runs(STUDY, point, name).recorded["position"][flight] for name in (filter_, BELOW)
    )
    return own - known


def in_space(results: Results, point: str) -> Figure:
    """Fig. 8: one flight with every filter in space; how far each is from that on the IEKF."""
    flight = shown_flight(results, point, "rbpf_fast")
    log = results.log(STUDY, point)
    path = quadrotor.reference(log.parameters)
    time = np.arange(len(path)) * log.parameters.period
    drawn = style.pyplot.figure(figsize=(style.WIDTH, 4.6))
    space: Any = drawn.add_subplot(1, 2, 1, projection="3d")  # its stubs refuse zoom=0.85
    beside = drawn.add_subplot(1, 2, 2)
    space.plot(*path[:, :3].T, color="black", lw=1.2, label="reference path")
    for filter_, look in _lines(results, point).items():
        flown = results.runs(STUDY, point, filter_).recorded["position"][flight.trial]
        space.plot(*flown.T, label=_name(filter_), **look)
        space.plot(*flown[-1:].T, "^", color="red", ms=5, zorder=5)
        if filter_ != BELOW:
            apart = np.linalg.norm(_deviation(results, point, filter_, flight.trial), axis=1)
            beside.plot(time, apart, lw=1.3, color=look["color"])
    space.plot([], [], "^", color="red", label="end points")
    space.set(xlabel="X in m", ylabel="Y in m", zlabel="Z in m", zlim=(2, 4))
    space.set(xticks=[-1, 0, 1], yticks=[0, 0.5, 1], zticks=[2, 2.5, 3, 3.5, 4])
    space.view_init(elev=28, azim=-60)
    space.set_box_aspect(None, zoom=0.85)
    beside.set(xlabel="time in s", ylabel="distance in m", ylim=(0, None))
    beside.set_title(f"distance to the flight on the {_name(BELOW)}", fontsize=9)
    handles, labels = space.get_legend_handles_labels()
    drawn.legend(handles, labels, fontsize=8, ncols=4, handlelength=3.6, loc="outside lower center")
    drawn.suptitle(f"flight: {flight.words} with the RBPF", fontsize=10)
    return drawn


def over_time(results: Results, point: str) -> Figure:
    """Fig. 9: X, Y, Z of the same flight, and less that on the IEKF; all flights' distances."""
    flight = shown_flight(results, point, "rbpf_fast")
    log = results.log(STUDY, point)
    path = quadrotor.reference(log.parameters)
    time = np.arange(len(path)) * log.parameters.period
    drawn, grid = style.figure(4, 2, size=(style.WIDTH, 8.8), sharex=True)
    for filter_, look in _lines(results, point).items():
        runs = results.runs(STUDY, point, filter_)
        apart = _deviation(results, point, filter_, flight.trial)
        flown = runs.recorded["position"][flight.trial]
        for i, (axes, beside) in enumerate(grid[:3]):
            axes.plot(time, flown[:, i], label=_name(filter_), **look)
            if filter_ != BELOW:
                beside.plot(time, apart[:, i], lw=1.2, color=look["color"])
        _band(grid[3, 0], time, runs.recorded["distance"], look)
        known = results.runs(STUDY, point, BELOW).recorded["distance"]
        if filter_ != BELOW:
            more = np.median(runs.recorded["distance"] - known, axis=0)
            grid[3, 1].plot(time, more, lw=1.2, color=look["color"])
    lag = np.median(results.runs(STUDY, point, "true_state").recorded["distance"], axis=0)
    grid[3, 0].plot(time, lag, color="black", lw=1, ls=":", label="true state fed back (the lag)")
    for (axes, beside), wanted, name in zip(grid, path[:, :3].T, "XYZ", strict=False):
        axes.plot(time, wanted, color="black", lw=0.9, label="reference")
        axes.set(ylabel=f"{name} in m")
        beside.set(ylabel=f"{name}, difference in m")
    grid[2, 0].set(ylim=(2.4, 3.6))
    grid[3, 0].set(xlabel="time in s", ylabel="distance in m", ylim=(0, None))
    grid[3, 1].set(xlabel="time in s", ylabel="difference in m")
    for axes, title in (
        (grid[0, 0], flight.words + " with the RBPF"),
        (grid[0, 1], f"less the flight on the {_name(BELOW)}"),
        (
            grid[3, 0],
            f"distance to the reference, {len(log.trials)} flights:\nmedian, band 10 to 90 %",
        ),
        (grid[3, 1], "median of the difference\nof the distances"),
    ):
        axes.set_title(title, fontsize=9)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    last, name = grid[3, 0].get_legend_handles_labels()
    drawn.legend(
        handles + last[-1:],
        labels + name[-1:],
        fontsize=8,
        ncols=4,
        handlelength=3.6,
        loc="outside lower center",
    )
    return drawn


def _band(axes: Axes, time: np.ndarray, distance: np.ndarray, look: dict[str, Any]) -> None:
    low, middle, high = np.quantile(distance, (0.1, 0.5, 0.9), axis=0)
    axes.plot(time, middle, **look)
    axes.fill_between(time, low, high, color=look["color"], alpha=0.08, lw=0)


def ignoring_losses(results: Results, titles: Mapping[str, str]) -> Figure:
    """Fig. 10: tracking error of the EKF that ignores the losses; `titles` by point."""
    ignoring = style.look(results, "ekf")["color"]
    drawn, grid = style.figure(1, len(titles), size=(style.WIDTH, 4.8))
    for axes, (point, title) in zip(grid, titles.items(), strict=True):
        parameters = results.log(STUDY, point).parameters
        runs = results.runs(STUDY, point, "ekf")
        distance, end = runs.recorded["distance"], runs.recorded["end"]
        time = np.arange(distance.shape[1]) * parameters.period
        typical = shown_flight(results, point, "ekf")
        for flight, (values, last) in enumerate(zip(distance, end, strict=True)):
            thick = flight == typical.trial
            look = {"color": ignoring, "lw": 1.6} if thick else {"color": "0.7", "lw": 0.5}
            axes.plot(time[:last], values[:last], zorder=2 + thick, **look)
            if last < len(time):
                axes.plot(time[last - 1], values[last - 1], "x", color="red", ms=5, zorder=4)
        for filter_ in results.and_own(STUDY, point, ["ekf_no_loss"]):
            flown = results.runs(STUDY, point, filter_).recorded["distance"]
            colour = style.look(results, filter_)["color"]
            label = f"{_name(filter_)}, median"
            axes.plot(time, np.median(flown, axis=0), color=colour, lw=1.4, label=label)
        axes.plot([], [], color=ignoring, lw=1.6, label=f"losses ignored, {typical.words}")
        axes.plot([], [], color="0.7", lw=0.5, label=f"losses ignored, all {len(end)} flights")
        ended = quadrotor.ended(runs)
        if ended.any():
            label = f"flight ended ({ended.sum()} of {len(ended)})"
            axes.plot([], [], "x", color="red", label=label)
        axes.set(xlabel="time in s", ylabel="distance to the reference in m", title=title)
        axes.title.set_fontsize(9)
        _expected_bias(axes, parameters)
        if ended.any():
            axes.set(yscale="log", ylim=(0.5, None))
        axes.legend(fontsize=7.5, loc="upper center", bbox_to_anchor=(0.5, -0.16))
    return drawn


def _expected_bias(axes: Axes, parameters: quadrotor.Parameters) -> None:
    """Where the loop settles if it does: the estimate (1 - p) Z at the command."""
    p = parameters.loss_probability
    altitude = quadrotor.reference(parameters)[0, 2]
    label = "bias of the altitude, $Zp/(1-p)$"
    axes.axhline(altitude * p / (1 - p), color="black", ls="--", lw=1, label=label)
