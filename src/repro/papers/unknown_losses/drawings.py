"""[unknown_losses Figs. 1-5]: filters that do not know which measurement is lost."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.papers.unknown_losses.points import PICTURED, PROPOSED, particle_sweeps, swept
from repro.plot import style
from repro.plot.style import BAND
from repro.plot.sweep import running, sweep
from repro.studies import radar
from repro.tables.results import Results

LINEAR = {"ekf": "KF (losses ignored)", "iekf": "IKF (losses known)"}
RADAR = {"iekf": "IEKF (losses known)"}
STYLES = ("-", "--", ":")
WIDEST, NARROWER = 3.4, 0.8  # lines of equal tracks, drawn over each other, stay visible


def rows_of(table: pd.DataFrame, metric: str, filter_: str) -> pd.DataFrame:
    """Rows of one metric and filter, by point."""
    return table[(table["metric"] == metric) & (table["filter"] == filter_)].set_index("point")


def _sum_over_steps(results: Results, point: str) -> str:
    """Title of the axis of the sum of RMSE_k."""
    return f"sum of RMSE$_k$ over {results.parameters('linear_losses', point).steps} steps"


def error_over_p(results: Results) -> Figure:
    """Fig. 1, and beside it the same relative to the IKF, where the three can be told apart."""
    study, points = "linear_losses", swept(results.catalogue, "linear_losses")
    first = next(iter(points.values()))
    drawn, (axes, ratio) = style.figure(1, 2, size=(9.4, 4.0))
    sweep(axes, results, study, points, "rmse_sum", "state", LINEAR, PICTURED[study])
    table = results.table(study)
    best = rows_of(table, "rmse_sum", "iekf")["value"]
    for filter_, on in running(results, study, points, PROPOSED).items():
        names = list(on.values())
        rmse = rows_of(table, "rmse_sum", filter_).loc[names, "value"]
        look = style.look(results, filter_)
        label = style.label(filter_)
        ratio.plot(list(on), rmse / best.loc[names], ms=4, lw=1.3, label=label, **look)
    ratio.axhline(1.0, color=style.look(results, "iekf")["color"], lw=1.3)
    trials = int(table.set_index("point").loc[first, "trials"].iloc[0])
    axes.set(
        ylabel=_sum_over_steps(results, first),
        title=f"{trials} runs; bands ±{BAND:g} standard errors",
    )
    ratio.set(ylabel="the same, relative to the IKF", title="what not knowing the losses costs")
    for part in (axes, ratio):
        part.set_xlabel("loss probability p")
    axes.legend(fontsize=8)
    ratio.legend(fontsize=8)
    return drawn


def particles_needed(results: Results, times: pd.DataFrame) -> Figure:
    """Fig. 2: time of an iteration, RMSE and number of distinct triples over N."""
    drawn, (clock, error, triples) = style.figure(1, 3, size=(11.5, 3.9))
    table = results.table("linear_losses")
    sweeps = particle_sweeps(results.catalogue)
    numbers: list[int] = []
    label = ""
    for (p, of_numbers), line in zip(sweeps.items(), STYLES, strict=False):
        for filter_ in ("rbpf", "rbpf_fast"):
            look = style.look(results, filter_)
            taken = times[(times["filter"] == filter_) & (times["loss"] == p)]
            name = f"{style.label(filter_)}, p = {p}"
            clock.plot(taken["particles"], taken["microseconds"], ls=line, ms=4, label=name, **look)
        numbers, points = list(of_numbers), list(of_numbers.values())
        label = _sum_over_steps(results, points[0])
        for filter_, on in running(results, "linear_losses", of_numbers, ["rbpf"]).items():
            rows = rows_of(table, "rmse_sum", filter_).loc[list(on.values())]
            look = style.look(results, filter_)
            own = f"{style.label(filter_)}, " if filter_ in results.own_filters else ""
            name, band = f"{own}p = {p}", BAND * rows["mcse"]
            error.errorbar(list(on), rows["value"], band, ls=line, ms=4, label=name, **look)
        distinct = rows_of(table, "triples", "rbpf_fast").loc[points, "value"]
        look = style.look(results, "rbpf_fast")
        triples.plot(numbers, distinct, ls=line, ms=4, label=f"p = {p}", **look)
    triples.plot(numbers, numbers, color="black", lw=0.8, label="all different")
    clock.set(yscale="log", ylabel="time of an iteration in µs")
    clock.set_title(times["machine"].iloc[0].replace("; ", "\n"), fontsize=8)
    error.set(ylabel=label, yscale="log")
    error.set_yticks([450, 500, 600, 800, 1200], ["450", "500", "600", "800", "1200"], minor=False)
    error.set_yticks([], minor=True)
    triples.set(yscale="log", ylabel="distinct triples of Algorithm 4")
    for axes in (clock, error, triples):
        axes.set(xscale="log", xlabel="particles N")
        axes.legend(fontsize=8)
    return drawn


def _over_time(
    axes: Axes, results: Results, curves: pd.DataFrame, point: str, line: str, median: bool
) -> None:
    period = results.parameters("radar", point).sampling_time
    for filter_ in results.and_own("radar", point, PICTURED["radar"]):
        look: dict[str, Any] = style.look(results, filter_) | {"marker": ""}
        rows = curves[(curves["point"] == point) & (curves["filter"] == filter_)]
        rows = rows[rows["k"] > 0]
        time = rows["k"] * period
        name = RADAR.get(filter_, style.label(filter_))
        axes.plot(time, rows["value"], ls=line, lw=1.4, label=name, **look)
        # The error of the logarithm, for a logarithmic axis.
        factor = np.exp(BAND * rows["mcse"] / rows["value"])
        low, high = rows["value"] / factor, rows["value"] * factor
        axes.fill_between(time, low, high, color=look["color"], alpha=0.12, lw=0)
        if median:
            axes.plot(time, rows["median"], ls=":", lw=1.1, color=look["color"])
    axes.set(yscale="log", xlabel="time in s", ylabel="position RMSE in m")
    axes.label_outer()


def _at_p(results: Results, point: str) -> str:
    return f"p = {results.parameters('radar', point).loss_probability}"


def error_over_time(results: Results, points: Sequence[str]) -> Figure:
    """Fig. 3: one panel a point, with the medians of the single runs."""
    curves = results.curves("radar")
    drawn, grid = style.figure(2, 2, size=(8.6, 6.6), sharex=True, sharey=True)
    for axes, point in zip(grid.flat, points, strict=True):
        _over_time(axes, results, curves, point, "-", median=True)
        axes.set_title(_at_p(results, point))
    grid.flat[0].plot([], [], "k:", label="median of the runs")
    grid.flat[0].legend(fontsize=7.5)
    return drawn


def error_over_time_together(results: Results, points: Sequence[str]) -> Figure:
    """Fig. 4: several points on one axis."""
    curves = results.curves("radar")
    drawn, axes = style.figure(size=(7.4, 5.0))
    for point, line in zip(points, STYLES, strict=True):
        _over_time(axes, results, curves, point, line, median=False)
    named = {}
    for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
        named.setdefault(label, handle)  # as at the first point that it runs on
    first = axes.legend(named.values(), named.keys(), fontsize=8, loc="lower right")
    axes.add_artist(first)
    lines = [axes.plot([], [], color="black", ls=line)[0] for line in STYLES]
    axes.legend(lines, [_at_p(results, p) for p in points], fontsize=8, loc="upper left")
    return drawn


def typical_trial(results: Results, point: str) -> int:
    """The number of the run in which the RBPF's last error is the median of all runs."""
    error = radar.final_error(results.runs("radar", point, "rbpf"))
    return int(np.argsort(error, kind="stable")[len(error) // 2])


def tracks(results: Results, point: str) -> Figure:
    """Figs. 5a-c: true and estimated positions of a typical run, its errors and the median ones."""
    trial = typical_trial(results, point)
    log, analysis = results.log("radar", point), results.analysis("radar")
    truth = log.values["/truth"][trial]
    received = log.field("/network", "gamma")[trial]
    drawn, (plane, axes) = style.figure(1, 2, size=(9.6, 4.4))
    plane.plot(truth[:, 0], truth[:, 3], color="black", lw=2.2, label="true", zorder=3)
    time = np.arange(1, len(truth)) * log.parameters.sampling_time
    ends = []
    for i, filter_ in enumerate(results.and_own("radar", point, PICTURED["radar"])):
        width = max(WIDEST - i * NARROWER, 0.8)
        runs = results.runs("radar", point, filter_)
        look = style.look(results, filter_)
        estimate = truth + runs.error[trial]
        name = RADAR.get(filter_, style.label(filter_))
        plane.plot(estimate[:, 0], estimate[:, 3], lw=width, ms=3, markevery=10, label=name, **look)
        error = np.sqrt(radar.squared_error(runs))
        axes.plot(time, error[trial], color=look["color"], lw=width)
        axes.plot(time, np.median(error, axis=0), color=look["color"], lw=1.0, ls=":")
        lost = radar.STUDY.lost(runs, analysis).mean()
        ends.append(f"{name.split(' (')[0]} {lost:.0%}")
    plane.plot(0, 0, "^", color="0.4", label="radar")
    plane.plot(*truth[0, [0, 3]], "o", color="black", mfc="none", label="start")
    plane.set(xlabel="first coordinate in m", ylabel="second coordinate in m", aspect="equal")
    plane.set_adjustable("datalim")
    plane.set_title(f"{point}, run {trial}, root seed {log.seed}", fontsize=9)
    plane.legend(fontsize=7.5)
    axes.set(yscale="log", xlabel="time in s", ylabel="position error in m")
    axes.plot([], [], color="0.4", lw=1.2, label="this run")
    axes.plot([], [], color="0.4", lw=1.0, ls=":", label="median of all runs")
    for k in np.flatnonzero(received[1:] == 1):
        axes.axvline(time[k], ymax=0.03, color="black", lw=0.8)
    axes.plot([], [], color="black", lw=0.8, label="packet received (ticks below)")
    axes.legend(fontsize=7.5)
    axes.set_title(
        f"share of all runs that end > {analysis.lost_above:g} m off:\n" + ", ".join(ends),
        fontsize=8,
    )
    return drawn
