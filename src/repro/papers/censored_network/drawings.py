"""Figures 2-15 and Tables I and II of censored_network: tracks, received values, RMSE over k."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.logs import Log
from repro.network.censoring import EXACT
from repro.papers.censored_network.time_averages import POINT, time_average
from repro.plot import style
from repro.statistics.runs import Runs
from repro.statistics.typical_run import TypicalRun, typical_run
from repro.studies.families.censored_network import (
    COMPONENTS,
    STATE,
    TARGETS,
    sensors,
    squared_distance,
)
from repro.tables.results import Results

MODEL = {"deadband": "DBLMC", "saturation": "SLMC"}


def shown(results: Results, study: str) -> list[str]:
    """The filters of Figs. 6-8 and 13-15 and the tables, dead reckoning, and a reader's own.

    The paper has no dead reckoning: it is the baseline that every filter should beat.
    """
    ranking = results.ranking(study)
    return results.and_own(study, POINT, [*ranking.papers, *filter(None, [ranking.nothing])])


def label(results: Results, study: str, filter_: str) -> str:
    """The paper's name of a filter: MAPF-DBLMC-NC for MAPF-NC in the study deadband."""
    if filter_ not in results.ranking(study).papers:
        return style.label(filter_)
    kind, *variant = style.label(filter_).split("-", 1)
    return "-".join([kind, MODEL[study], *variant])


def shown_run(results: Results, study: str) -> TypicalRun:
    """The median run of the proposed filter, by its mean square error over k and the targets."""

    def mean_square(runs: Runs) -> np.ndarray:
        return squared_distance(runs)[:, 1:].mean(axis=(1, 2))

    return typical_run([results.each(study, POINT, "mapf", mean_square)])


def tracks(results: Results, study: str, target: int) -> Figure:
    """True and estimated positions of the targets in one run, with the sensors; ours is bold."""
    log, run = results.log(study, POINT), shown_run(results, study)
    drawn, grid = style.figure(1, len(TARGETS), size=(style.WIDTH, 4.1), sharex=True, sharey=True)
    for place, axes in enumerate(grid):
        _track(axes, results, log, study, place, run.trial)
        axes.title.set_fontweight("bold" if place == target - 1 else "normal")
        axes.set(xlabel=r"$p_x$ in m", ylabel=r"$p_y$ in m", aspect="equal")
        axes.label_outer()
    handles, labels = grid[0].get_legend_handles_labels()
    drawn.legend(handles, labels, fontsize=8, ncols=4, loc="outside lower center")
    drawn.suptitle(f"{run.words} of MAPF", fontsize=10)
    return drawn


def _track(axes: Axes, results: Results, log: Log, study: str, place: int, trial: int) -> None:
    """Draw one target, numbered from 0."""
    first = len(STATE) * place
    columns = slice(first, first + 2)
    truth = log.values["/truth"][trial, :, columns]
    for group, (positions, marker) in enumerate(zip(sensors(log.parameters), "^v", strict=True)):
        look = {"mfc": "none", "color": "0.45", "ms": 5}
        axes.plot(*positions.T, marker, **look, label=f"sensors, group {group + 1}")
    axes.plot(*truth.T, color="black", lw=1.6, label="true")
    title = f"target {place + 1}"
    for filter_ in results.and_own(study, POINT, ("dead_reckoning", "mapf")):
        error = results.runs(study, POINT, filter_).error[trial, :, columns]
        line = style.look(results, filter_)
        if line["marker"] != "None":
            line["marker"] = "."
        rms = np.sqrt((error[1:] ** 2).sum(axis=1).mean())
        name = label(results, study, filter_)
        axes.plot(*(truth + error).T, lw=1.1, ms=4, **line, label=name)
        title += f"\n{name}: {rms:.2f} m rms"
    axes.plot(*truth[0], "o", color="black", ms=5, label="k = 0")
    axes.set_title(title, fontsize=8.5)


def first_component(results: Results, study: str) -> Figure:
    """Target 1: which group transmits, and the first of the three values that arrive."""
    log, run = results.log(study, POINT), shown_run(results, study)
    trial = run.trial
    group = log.field("/network", "group_1")[trial, 1:]
    value = log.field("/received", "value_1_1")[trial, 1:]
    exact = log.field("/received", "code_1_1")[trial, 1:] == EXACT
    k = np.arange(1, len(group) + 1)
    drawn, (upper, lower) = style.figure(
        2, 1, size=(style.WIDTH, 5.0), sharex=True, gridspec_kw={"height_ratios": [4, 1]}
    )
    for m in (1, 2):
        ideal = log.field("/sensor", f"strength_1_{m}_1")[trial, 1:]
        upper.plot(
            k,
            ideal,
            lw=0.9,
            color=style.COLOURS[2 * (m - 1)],
            alpha=0.7,
            label=f"uncensored, first sensor of group {m}",
        )
    upper.plot(k[exact], value[exact], "o", color="black", ms=4, label="received, exact")
    upper.plot(
        k[~exact], value[~exact], "s", mfc="none", color="#D55E00", ms=5, label="received, censored"
    )
    for threshold in (log.parameters.lower_threshold, log.parameters.upper_threshold):
        upper.axhline(threshold, color="0.4", ls=":", lw=1)
    upper.plot([], [], color="0.4", ls=":", lw=1, label="thresholds")
    upper.set(ylabel=r"first component of $y_k^1$ in dB", title=f"target 1, {run.words} of MAPF")
    drawn.legend(fontsize=8, ncols=3, loc="outside lower center")
    lower.plot(k, group, "s", color="black", ms=3)
    lower.set(xlabel="k (steps)", ylabel=r"group $\rho_k^1$", yticks=[1, 2], ylim=(0.5, 2.5))
    return drawn


def rmse_over_k(results: Results, study: str, target: int) -> Figure:
    """RMSE over k with a band of two standard errors, and the printed averages."""
    curves = results.curves(study)
    curves = curves[(curves["metric"] == "rmse") & (curves["component"] == f"target_{target}")]
    published = results.diff()
    here = (published["study"] == study) & (published["component"] == f"target_{target}")
    published = published[here].set_index("filter")["published"]
    runs = results.in_shards(study, POINT, "mapf").trials
    drawn, axes = style.figure(size=(style.WIDTH, 4.9))
    for filter_ in shown(results, study):
        rows = curves[(curves["point"] == POINT) & (curves["filter"] == filter_)]
        line = style.look(results, filter_)
        name = label(results, study, filter_)
        axes.plot(rows["k"], rows["value"], lw=1.4, ms=4, markevery=8, label=name, **line)
        style.band(axes, rows["k"], rows["value"], rows["mcse"], line["color"])
        last, average = rows["k"].max(), time_average(results, study, filter_)
        ours, error = average.value[target - 1], average.mcse()[target - 1]
        length = style.bars(ours, error)[:, None]
        look = {"color": line["color"], "marker": "o", "ms": 4, "capsize": 2, "clip_on": False}
        axes.errorbar([1.09 * last], [ours], length, **look)
        if filter_ in published.index:
            axes.plot(
                [1.045 * last],
                [published[filter_]],
                **style.PUBLISHED | {"color": line["color"], "clip_on": False},
            )
    axes.plot([], [], **style.PUBLISHED, label="published, averaged over k")
    axes.errorbar(
        [], [], [], fmt="o", color="black", ms=4, capsize=2, label="ours, averaged over k"
    )
    axes.set(
        xlabel="k (steps)",
        ylabel="position RMSE in m",
        title=f"target {target}, {runs} runs; bands and bars ±{style.BAND:g} standard errors",
    )
    axes.title.set_fontsize(9.5)
    style.plain_log(axes)
    drawn.legend(*axes.get_legend_handles_labels(), fontsize=8, ncols=4, loc="outside lower center")
    return drawn


def time_averages(results: Results, study: str) -> Figure:
    """The table of time-averaged RMSE, published and ours, with both standard errors."""
    diff = results.diff()
    diff = diff[diff["study"] == study].set_index(["filter", "component"])
    drawn, grid = style.figure(1, 4, size=(style.WIDTH, 4.0), sharey=True)
    filters = shown(results, study)
    averages = {filter_: time_average(results, study, filter_) for filter_ in filters}
    for i, (component, axes) in enumerate(zip(COMPONENTS, grid, strict=True)):
        for place, (filter_, average) in enumerate(averages.items()):
            colour = style.look(results, filter_)["color"]
            value, error = average.value[i], average.mcse()[i]
            length = style.bars(value, error)[:, None]
            axes.errorbar(place + 0.12, value, length, fmt="o", ms=5, color=colour, capsize=3)
            if (filter_, component) in diff.index:
                row = diff.loc[(filter_, component)]
                axes.errorbar(
                    place - 0.12,
                    row["published"],
                    style.bars(row["published"], row["their_error"])[:, None],
                    fmt="_",
                    ms=11,
                    color="black",
                    capsize=3,
                )
        axes.set(
            title=component.replace("_", " "),
            xticks=np.arange(len(filters)),
            xlim=(-0.6, len(filters) - 0.4),
        )
        axes.set_xticklabels(
            [label(results, study, f) for f in filters], rotation=40, ha="right", fontsize=7.5
        )
        style.plain_log(axes)
    grid[0].errorbar([], [], [], fmt="_", ms=11, color="black", capsize=3, label="published")
    grid[0].errorbar([], [], [], fmt="o", ms=5, color="0.3", capsize=3, label="ours")
    grid[0].set_ylabel("time-averaged position RMSE in m")
    runs = results.in_shards(study, POINT, "mapf").trials
    drawn.suptitle(f"{runs} runs; bars ±{style.BAND:g} standard errors", fontsize=9.5)
    drawn.legend(fontsize=8, ncols=2, loc="outside lower center")
    return drawn


def sensitivity(results: Results) -> Figure:
    """Average RMSE under each reading, and which order holds, for both studies."""
    drawn, grid = style.figure(
        2, 2, size=(style.WIDTH, 7.6), sharey="row", gridspec_kw={"width_ratios": [3, 1.4]}
    )
    marks = {"holds": ("o", "full"), "undecided": ("o", "none"), "fails": ("X", "full")}
    for study, (left, right) in zip(MODEL, grid, strict=True):
        table = results.table(f"{study}_sensitivity")
        readings = list(dict.fromkeys(table["reading"]))
        levels = table[table["metric"] == "rmse"]
        for filter_ in dict.fromkeys(levels["filter"]):
            rows = levels[levels["filter"] == filter_]
            place = [readings.index(reading) for reading in rows["reading"]]
            line = style.look(results, filter_) | {"linestyle": "none"}
            if line["marker"] == "None":
                line["marker"] = "|"
            left.errorbar(
                rows["value"],
                place,
                xerr=style.bars(rows["value"], rows["mcse"]),
                ms=5,
                label=style.label(filter_),
                **line,
            )
        left.set(xscale="log", xlabel="RMSE in m, mean of the targets and of k", title=MODEL[study])
        left.set_yticks(np.arange(len(readings)), readings, fontsize=8)
        left.invert_yaxis()
        style.plain_log(left, "x")
        orders = table[table["metric"] == "order"]
        columns = list(dict.fromkeys(orders["filter"]))
        for order, reading, verdict in zip(
            orders["filter"], orders["reading"], orders["verdict"], strict=True
        ):
            marker, fill = marks[verdict]
            right.plot(
                columns.index(order),
                readings.index(reading),
                marker,
                fillstyle=fill,
                color="#D55E00" if verdict == "fails" else "black",
                ms=7,
            )
        names = [
            " < ".join(style.label(f) for f in column.split(" < ")).replace("dead reckoning", "DR")
            for column in columns
        ]
        right.set_xticks(np.arange(len(columns)), names, rotation=30, ha="right", fontsize=8)
        right.set_xlim(-0.5, len(columns) - 0.5)
    legend = grid[0, 0].get_legend_handles_labels()
    drawn.legend(*legend, fontsize=8, ncols=5, loc="outside upper left")
    grid[0, 1].set_title("order: full holds, ring undecided, cross fails", fontsize=8)
    return drawn
