"""[unknown_losses Figs. 8-10]: flights on the filters' estimates."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.papers.unknown_losses.points import PICTURED
from repro.plot import style
from repro.studies import quadrotor
from repro.tables.results import Results

STUDY = "quadrotor"
NAMES = {"ekf_no_loss": "EKF (no losses)", "iekf": "IEKF (losses known)", "rbpf_fast": "RBPF"}
IGNORING = "#D55E00"
# Most of Figs. 8, 9 overlap: their dashes alternate on the line of the IEKF.
LINES = {
    "ekf_no_loss": {"lw": 1.4},
    "iekf": {"lw": 2.6},
    "bkf_1": {"lw": 1.5, "ls": (0, (4, 8))},
    "bkf_2": {"lw": 1.5, "ls": (4, (4, 8))},
    "rbpf_fast": {"lw": 1.5, "ls": (8, (4, 8))},
}
OTHER_LINE = {"lw": 1.2, "ls": ":"}  # a reader's own filter


def _name(filter_: str) -> str:
    return NAMES.get(filter_, style.label(filter_))


def _line(results: Results, filter_: str) -> dict[str, Any]:
    return {"color": style.look(results, filter_)["color"]} | LINES.get(filter_, OTHER_LINE)


def typical_flight(results: Results, point: str, filter_: str) -> int:
    """The flight whose rms distance to the reference is the median of all flights."""
    distance = quadrotor.squared_distance(results.runs(STUDY, point, filter_))
    return int(np.argsort(distance, kind="stable")[len(distance) // 2])


def in_space(results: Results, point: str) -> Figure:
    """Fig. 8: one flight with every filter in space, and the same from above."""
    flight = typical_flight(results, point, "rbpf_fast")
    log = results.log(STUDY, point)
    path = quadrotor.reference(log.parameters)
    drawn = style.pyplot.figure(figsize=(10.6, 5.0))
    space: Any = drawn.add_subplot(1, 2, 1, projection="3d")  # its stubs refuse zoom=0.88
    above = drawn.add_subplot(1, 2, 2)
    space.plot(*path[:, :3].T, color="black", lw=2, label="reference path")
    above.plot(*path[:, :2].T, color="black", lw=2)
    for filter_ in results.and_own(STUDY, point, PICTURED[STUDY]):
        flown = results.runs(STUDY, point, filter_).recorded["position"][flight]
        look = _line(results, filter_)
        space.plot(*flown.T, label=_name(filter_), **look)
        above.plot(*flown[:, :2].T, **look)
        space.plot(*flown[-1:].T, "^", color="red", ms=6, zorder=5)
        above.plot(*flown[-1:, :2].T, "^", color="red", ms=6, zorder=5)
    space.plot([], [], "^", color="red", label="end points")
    space.set(xlabel="X in m", ylabel="Y in m", zlabel="Z in m", zlim=(2, 4))
    space.set(xticks=[-1, 0, 1], yticks=[0, 0.5, 1], zticks=[2, 2.5, 3, 3.5, 4])
    space.view_init(elev=28, azim=-60)
    space.set_box_aspect(None, zoom=0.88)
    space.legend(fontsize=7.5, handlelength=4, loc="upper left", bbox_to_anchor=(-0.05, 1.02))
    above.set(xlabel="X in m", ylabel="Y in m", aspect="equal", title="from above")
    drawn.suptitle(f"flight {flight}, root seed {log.seed}", fontsize=10)
    return drawn


def over_time(results: Results, point: str) -> Figure:
    """Fig. 9: X, Y, Z of the same flight over time, and the distance to the path in all flights."""
    flight = typical_flight(results, point, "rbpf_fast")
    log = results.log(STUDY, point)
    path = quadrotor.reference(log.parameters)
    time = np.arange(len(path)) * log.parameters.period
    drawn, grid = style.figure(4, 1, size=(8.0, 8.6), sharex=True)
    for filter_ in results.and_own(STUDY, point, PICTURED[STUDY]):
        runs = results.runs(STUDY, point, filter_)
        look = _line(results, filter_)
        for axes, flown in zip(grid, runs.recorded["position"][flight].T, strict=False):
            axes.plot(time, flown, label=_name(filter_), **look)
        _band(grid[3], time, runs.recorded["distance"], look)
    lag = np.median(results.runs(STUDY, point, "true_state").recorded["distance"], axis=0)
    grid[3].plot(time, lag, color="black", lw=1, ls=":", label="true state fed back (the lag)")
    for axes, wanted, name in zip(grid, path[:, :3].T, "XYZ", strict=False):
        axes.plot(time, wanted, color="black", ls="--", lw=1.4, label="reference")
        axes.set(ylabel=f"{name} in m")
    grid[2].set(ylim=(2.4, 3.6))
    grid[3].set(xlabel="time in s", ylabel="distance in m", ylim=(0, None))
    grid[3].set_title(
        f"distance to the reference: median of {len(log.trials)} flights, bands 10 to 90 %",
        fontsize=9,
    )
    grid[0].set_title(f"flight {flight}, root seed {log.seed}", fontsize=9)
    grid[0].legend(fontsize=7.5, ncols=2, handlelength=4)
    grid[3].legend(fontsize=7.5)
    return drawn


def _band(axes: Axes, time: np.ndarray, distance: np.ndarray, look: dict[str, Any]) -> None:
    low, middle, high = np.quantile(distance, (0.1, 0.5, 0.9), axis=0)
    axes.plot(time, middle, **look)
    axes.fill_between(time, low, high, color=look["color"], alpha=0.08, lw=0)


def ignoring_losses(results: Results, points: Sequence[str]) -> Figure:
    """Fig. 10: tracking error of the EKF that ignores the losses, one panel a point."""
    drawn, grid = style.figure(1, len(points), size=(5.0 * len(points), 4.2))
    for axes, point in zip(grid, points, strict=True):
        parameters = results.log(STUDY, point).parameters
        runs = results.runs(STUDY, point, "ekf")
        distance, end = runs.recorded["distance"], runs.recorded["end"]
        time = np.arange(distance.shape[1]) * parameters.period
        typical = typical_flight(results, point, "ekf")
        for flight, (values, last) in enumerate(zip(distance, end, strict=True)):
            thick = flight == typical
            look = {"color": IGNORING, "lw": 1.6} if thick else {"color": "0.7", "lw": 0.5}
            axes.plot(time[:last], values[:last], zorder=2 + thick, **look)
            if last < len(time):
                axes.plot(time[last - 1], values[last - 1], "x", color="red", ms=5, zorder=4)
        for filter_ in results.and_own(STUDY, point, ["ekf_no_loss"]):
            flown = results.runs(STUDY, point, filter_).recorded["distance"]
            own = filter_ in results.own_filters
            colour = style.look(results, filter_)["color"] if own else style.COLOURS[0]
            label = f"{_name(filter_)}, median"
            axes.plot(time, np.median(flown, axis=0), color=colour, lw=1.4, label=label)
        axes.plot([], [], color=IGNORING, lw=1.6, label=f"losses ignored, flight {typical}")
        axes.plot([], [], color="0.7", lw=0.5, label=f"losses ignored, all {len(end)} flights")
        ended = quadrotor.ended(runs)
        if ended.any():
            label = f"flight ended ({ended.sum()} of {len(ended)})"
            axes.plot([], [], "x", color="red", label=label)
        axes.set(xlabel="time in s", ylabel="distance to the reference in m", title=point)
        _expected_bias(axes, parameters)
        if ended.any():
            axes.set(yscale="log", ylim=(0.5, None))
        axes.legend(fontsize=7.5)
    return drawn


def _expected_bias(axes: Axes, parameters: quadrotor.Parameters) -> None:
    """Where the loop settles if it does: the estimate (1 - p) Z at the command."""
    p = parameters.loss_probability
    altitude = quadrotor.reference(parameters)[0, 2]
    label = "bias of the altitude, $Zp/(1-p)$"
    axes.axhline(altitude * p / (1 - p), color="black", ls="--", lw=1, label=label)
