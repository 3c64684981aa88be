"""[unknown_losses Figs. 1-5]: filters that do not know which measurement is lost."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.papers.unknown_losses.points import PICTURED, PROPOSED, particle_sweeps, swept
from repro.parameters.point_names import is_reading
from repro.plot import style
from repro.plot.style import BAND
from repro.plot.sweep import running, sweep
from repro.statistics.typical_run import TypicalRun, typical_run
from repro.studies import radar
from repro.tables.results import Results

LINEAR = {"ekf": "KF (losses ignored)", "iekf": "IKF (losses known)"}
RADAR = {"iekf": "IEKF (losses known)"}
STYLES = ("-", "--", ":")


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
    drawn, (axes, ratio) = style.figure(1, 2, size=(style.WIDTH, 4.2))
    sweep(axes, results, study, points, "rmse_sum", "state", LINEAR, PICTURED[study], log=True)
    style.plain_log(axes)
    table = results.table(study)
    best = rows_of(table, "rmse_sum", "iekf")["value"]
    for filter_, on in running(results, study, points, PROPOSED).items():
        names = list(on.values())
        rmse = rows_of(table, "rmse_sum", filter_).loc[names, "value"]
        look = style.look(results, filter_)
        label = style.label(filter_)
        ratio.plot(list(on), rmse / best.loc[names], ms=4, lw=1.3, label=label, **look)
    ratio.axhline(1.0, color=style.look(results, "iekf")["color"], lw=1.3)
    _draw_optimum(ratio, results)
    trials = int(table.set_index("point").loc[first, "trials"].iloc[0])
    axes.set(
        ylabel=_sum_over_steps(results, first),
        title=f"{trials} runs; bands ±{BAND:g} standard errors",
    )
    ratio.set(ylabel="the same, relative to the IKF", title="what not knowing the losses costs")
    for part in (axes, ratio):
        part.set_xlabel("loss probability p")
        part.title.set_fontsize(9.5)
    axes.legend(fontsize=8)
    ratio.legend(fontsize=8)
    return drawn


def _draw_optimum(axes: Axes, results: Results) -> None:
    """The exact filter, whose terms double each step: on a short run."""
    table = results.table("linear_losses")
    for point, filters in results.catalogue["linear_losses"].items():
        if "exact" in filters and not is_reading(point):
            rows = rows_of(table, "rmse_sum", "exact"), rows_of(table, "rmse_sum", "iekf")
            exact, known = (float(of.loc[point, "value"]) for of in rows)
            used = results.parameters("linear_losses", point)
            axes.plot(
                used.loss_probability,
                exact / known,
                ls="none",
                ms=9,
                label=f"exact filter, {used.steps} steps only",
                **style.look(results, "exact"),
            )


def particles_needed(results: Results, times: pd.DataFrame) -> Figure:
    """Fig. 2: time of an iteration, RMSE and number of distinct triples over N."""
    drawn, (clock, error, triples) = style.figure(1, 3, size=(style.WIDTH, 3.6))
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
            name, band = f"{own}p = {p}", style.bars(rows["value"], rows["mcse"])
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
        axes.legend(fontsize=7)
    return drawn


def error_over_time(results: Results, points: Sequence[str]) -> Figure:
    """Figs. 3 and 4: a panel a point; median and quantiles of the runs, and thin the RMSE."""
    curves = results.curves("radar")
    columns = 2 if len(points) % 2 == 0 else len(points)
    rows = len(points) // columns
    size = (style.WIDTH, 3.1 * rows + 1.0)
    drawn, grid = style.figure(rows, columns, size=size, sharex=True, sharey=True, squeeze=False)
    for axes, point in zip(grid.flat, points, strict=True):
        _over_time(axes, results, curves, point)
        style.plain_log(axes)
        axes.set(xlabel="time in s", ylabel="position error in m")
        axes.label_outer()
    handles = [
        *grid.flat[0].get_legend_handles_labels()[0],
        *grid.flat[0].plot([], [], color="0.4", lw=1.8, label="median run, band 10 to 90 %"),
        *grid.flat[0].plot([], [], color="0.4", lw=0.7, label=f"RMSE (ends: ±{BAND:g} st. errors)"),
    ]
    drawn.legend(handles=handles, fontsize=8, ncols=3, handlelength=3.6, loc="outside lower center")
    return drawn


def _over_time(axes: Axes, results: Results, curves: pd.DataFrame, point: str) -> None:
    parameters, analysis = results.parameters("radar", point), results.analysis("radar")
    lost, trials = [], 0
    names = results.and_own("radar", point, PICTURED["radar"])
    for place, filter_ in enumerate(names):
        colour = style.look(results, filter_)["color"]
        rows = curves[(curves["point"] == point) & (curves["filter"] == filter_)]
        rows = rows[rows["k"] > 0]
        time = rows["k"] * parameters.sampling_time
        name = RADAR.get(filter_, style.label(filter_))
        line = style.interlaced(place, len(names))
        axes.plot(time, rows["median"], color=colour, label=name, **line)
        axes.fill_between(time, rows["q10"], rows["q90"], color=colour, alpha=0.1, lw=0)
        axes.plot(time, rows["value"], lw=0.7, color=colour)
        end, error = (np.asarray(rows[column])[-1:] for column in ("value", "mcse"))
        at = time.iloc[-1] * (1.02 + 0.025 * place)
        axes.errorbar(at, end, style.bars(end, error), color=colour, lw=1.0, capsize=2)
        ended = radar.STUDY.lost(results.runs("radar", point, filter_), analysis)
        lost.append(f"{name.split(' (')[0]} {ended.mean():.1%}")
        trials = len(ended)
    half = -(-len(lost) // 2)
    shares = ", ".join(lost[:half]) + ",\n" + ", ".join(lost[half:])
    axes.set_title(
        f"p = {parameters.loss_probability}, {trials} runs;"
        f" end > {analysis.lost_above:g} m off:\n{shares}",
        fontsize=8,
    )


def shown_run(results: Results, point: str) -> TypicalRun:
    """The run in which the RBPF's last error is the median of all runs."""
    return typical_run([radar.final_error(results.runs("radar", point, "rbpf"))])


def tracks(results: Results, point: str, title: str) -> Figure:
    """Figs. 5a-c: true and estimated positions of the median run, its errors, the median ones."""
    run = shown_run(results, point)
    log, analysis = results.log("radar", point), results.analysis("radar")
    truth = log.values["/truth"][run.trial]
    received = log.field("/network", "gamma")[run.trial]
    drawn, (plane, axes) = style.figure(1, 2, size=(style.WIDTH, 4.6))
    time = np.arange(1, len(truth)) * log.parameters.sampling_time
    ends = []
    names = results.and_own("radar", point, PICTURED["radar"])
    for place, filter_ in enumerate(names):
        runs = results.runs("radar", point, filter_)
        look = {"color": style.look(results, filter_)["color"]}
        estimate = truth + runs.error[run.trial]
        name = RADAR.get(filter_, style.label(filter_))
        line = style.interlaced(place, len(names))
        plane.plot(estimate[:, 0], estimate[:, 3], label=name, **look, **line)
        error = np.sqrt(radar.squared_error(runs))
        axes.plot(time, error[run.trial], **look, **line)
        axes.plot(time, np.median(error, axis=0), lw=1.0, ls=":", **look)
        lost = radar.STUDY.lost(runs, analysis).mean()
        ends.append(f"{name.split(' (')[0]} {lost:.0%}")
    plane.plot(truth[:, 0], truth[:, 3], color="black", lw=0.9, label="true", zorder=3)
    plane.plot(0, 0, "^", color="0.4", label="radar")
    plane.plot(*truth[0, [0, 3]], "o", color="black", mfc="none", label="start")
    plane.set(xlabel="first coordinate in m", ylabel="second coordinate in m", aspect="equal")
    plane.set_adjustable("datalim")
    plane.set_title(f"{title}: {run.words}", fontsize=9)
    axes.set(xlabel="time in s", ylabel="position error in m")
    style.error_axis(axes, "y")
    axes.plot([], [], color="0.4", lw=1.2, label="this run")
    axes.plot([], [], color="0.4", lw=1.0, ls=":", label="median of all runs")
    for k in np.flatnonzero(received[1:] == 1):
        axes.axvline(time[k], ymax=0.03, color="black", lw=0.8)
    axes.plot([], [], color="black", lw=0.8, label="received (ticks below)")
    axes.set_title(
        f"of all {len(log.trials)} runs end > {analysis.lost_above:g} m off:\n" + ", ".join(ends),
        fontsize=9,
    )
    handles = [h for part in (plane, axes) for h in part.get_legend_handles_labels()[0]]
    drawn.legend(handles=handles, fontsize=8, ncols=4, handlelength=3.6, loc="outside lower center")
    return drawn
