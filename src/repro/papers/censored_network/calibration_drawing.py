"""What the search for the geometry of censored_network has found, in one picture."""

from collections.abc import Hashable
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import label
from repro.plot import style
from repro.tables.results import Results

NAMES = {
    "speed": "v in m per step",
    "turn_rate": r"$\Omega$ in rad per step",
    "steps": "K in steps",
}
COMMITTED = "committed"
Row = dict[Hashable, Any]  # of a table, by column


def calibration(results: Results) -> Figure:
    """Profiles above; below: how well geometries fit, their sensors, and what they predict."""
    geometries = results.calibration("geometry").to_dict("records")
    profile = results.calibration("profile")
    drawn, grid = style.figure(2, 3, size=(11.4, 7.6))
    for name, axes in zip(NAMES, grid[0], strict=True):
        _profile(axes, profile.loc[profile["parameter"] == name], geometries, name)
    _misfits(grid[1, 0], geometries)
    _sensors(grid[1, 1], geometries)
    _left_out(grid[1, 2], results)
    return drawn


def _profile(axes: Axes, rows: pd.DataFrame, geometries: list[Row], name: str) -> None:
    """Misfit over one number, and the values of the geometries that fit as well as the best."""
    axes.errorbar(rows["value"], rows["misfit"], 2 * rows["mcse"], fmt="o-", ms=4, capsize=2)
    for row in geometries:
        if row["fit"] == COMMITTED:
            axes.axvline(row[name], color="black", ls=":", lw=1)
        elif row["equal"]:
            axes.axvline(row[name], ymax=0.05, color=style.COLOURS[1], lw=1.5)
    axes.set(xlabel=NAMES[name], ylabel="misfit to Tables I and II", ylim=(0, None))
    axes.set_title("ticks: geometries not told apart from the best", fontsize=7.5)


def _misfits(axes: Axes, geometries: list[Row]) -> None:
    """Misfit of every geometry on the same trials, the best first."""
    for place, row in enumerate(geometries):
        colour = "black" if row["fit"] == COMMITTED else style.COLOURS[0 if row["equal"] else 1]
        axes.errorbar(
            row["misfit"],
            place,
            xerr=2 * row["mcse"],
            fmt="o",
            ms=5,
            capsize=2,
            color=colour,
            mfc=colour if row["left_out"] != row["left_out"] else "white",
        )
    for name, colour in (
        ("committed geometry", "black"),
        ("not told apart from the best", style.COLOURS[0]),
        ("worse", style.COLOURS[1]),
    ):
        axes.plot([], [], "o", color=colour, label=name)
    axes.plot([], [], "o", color="0.3", mfc="white", label="fitted without one row")
    noise = float(np.median([row["noise"] for row in geometries]))
    axes.axvline(noise, color="0.5", ls="--", lw=1, label="our noise alone")
    axes.set(xlabel="misfit to Tables I and II", yticks=[], xlim=(0, None))
    searches = [row for row in geometries if row["fit"] != COMMITTED]
    effort = {int(row["evaluations"]) for row in searches}
    axes.set_title(
        f"{len(searches)} searches of {max(effort)} evaluations, judged on "
        f"{geometries[0]['trials']} trials",
        fontsize=7.5,
    )
    axes.invert_yaxis()
    axes.legend(fontsize=7)


def _sensors(axes: Axes, geometries: list[Row]) -> None:
    """Sensors of the geometries that fit as well as the best, and the committed ones."""
    for row in geometries:
        is_committed = row["fit"] == COMMITTED
        if not (row["equal"] or is_committed):
            continue
        for group, marker in ((1, "^"), (2, "v")):
            x = [row[name] for name in row if str(name).startswith(f"group_{group}_x")]
            y = [row[name] for name in row if str(name).startswith(f"group_{group}_y")]
            axes.plot(
                x,
                y,
                marker,
                ms=8 if is_committed else 5,
                color="black" if is_committed else style.COLOURS[group - 1],
                mfc="none" if is_committed else None,
                alpha=1.0 if is_committed else 0.6,
                label=f"group {group}, {'committed' if is_committed else 'found'}",
            )
    handles, labels = axes.get_legend_handles_labels()
    shown = dict(zip(labels, handles, strict=True))
    axes.legend(list(shown.values()), list(shown), fontsize=7)
    axes.set(xlabel="x in m", ylabel="y in m", aspect="equal", xlim=(0, 100), ylim=(0, 100))
    axes.set_title("sensors of all geometries not told apart from the best", fontsize=7.5)


def _left_out(axes: Axes, results: Results) -> None:
    """Average of each row as the fit to the others predicts it, and as printed."""
    table = results.calibration("left_out")
    rows = table.loc[table["component"] == "average"].to_dict("records")
    for place, row in enumerate(rows):
        value, error = row["predicted"], 2 * row["error"]
        below = min(error, 0.9 * value)  # the axis is logarithmic
        axes.errorbar(
            value, place, xerr=[[below], [error]], fmt="o", ms=5, capsize=3, color=style.COLOURS[0]
        )
        axes.plot(row["printed"], place, "x", color="black", ms=7)
    axes.plot([], [], "o", color=style.COLOURS[0], label="predicted by the other rows")
    axes.plot([], [], "x", color="black", label="printed")
    names = [label(results, row["study"], row["filter"]) for row in rows]
    axes.set_yticks(range(len(rows)), names, fontsize=7.5)
    axes.set(xlabel="RMSE in m, mean of the targets")
    style.plain_log(axes, "x")
    axes.invert_yaxis()
    axes.legend(fontsize=7)
