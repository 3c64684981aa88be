"""Verdicts at a glance: every published value and every comparison behind the claims of a paper."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.plot import style
from repro.statistics.paired import independent_error
from repro.tables.results import Results
from repro.verdicts.published import CLASSES

GOOD, OPEN, BAD = "#009E73", "#E69F00", "#D55E00"
COLOURS = {"match": GOOD, "holds": GOOD, "undecided": OPEN, "differs": BAD, "fails": BAD}
LARGEST = 12.0  # standard errors drawn; what is farther is an arrow at the edge
WIDTH, ROW = 7.7, 0.185  # inches: of a picture as pages show it, and of a row
ACCEPTED = "0.88"  # grey of where a value matches, or a comparison is undecided


def verdicts(results: Results, paper: str) -> Figure:
    """Above: values in standard errors from the printed ones. Below: comparisons of the claims.

    Exact values, and numbers against a bound, have no standard error to scale by: they are written.
    """
    diff = results.diff()
    diff = diff.loc[diff["paper"] == paper]
    values, claims = diff.loc[diff["kind"] == "value"], diff.loc[diff["kind"] == "claim"]
    exact = ~np.isfinite(values["z"].to_numpy())
    panels = [values.loc[~exact], claims]
    panels = [rows for rows in panels if len(rows)] or [claims]
    heights = [len(list(grouped(rows))) for rows in panels]
    size = (WIDTH, ROW * sum(heights) + 0.85 * len(panels))
    drawn, grid = style.figure(
        len(panels), 1, size=size, squeeze=False, gridspec_kw={"height_ratios": heights}
    )
    for axes, rows in zip(grid.flat, panels, strict=True):
        if rows is claims:
            _draw_claims(axes, rows, results.claims(paper), results.tolerance)
        else:
            _draw_values(axes, rows)
    if exact.any():
        drawn.suptitle(_exact(values.loc[exact]), fontsize=8.5, x=0.01, ha="left")
    return drawn


def grouped(rows: pd.DataFrame) -> Iterator[tuple[str, dict[Any, Any] | None]]:
    """Lines of a panel, top down: the name of a class of evidence, then each of its rows."""
    for name in CLASSES:
        of_class = rows.loc[rows["class"] == name].to_dict("records")
        if of_class:
            yield name, None
        for row in of_class:
            yield in_words(row["item"]), row


def in_words(item: str) -> str:
    """A claim's name in words; the names of values are words already."""
    return item if " " in item else item.replace("-", " ")


def _exact(values: pd.DataFrame) -> str:
    """Values without a Monte Carlo error, in a line."""
    counts = values["verdict"].value_counts()
    text = f"Exact values: {', '.join(f'{count} {verdict}' for verdict, count in counts.items())}"
    for row in values.loc[values["verdict"] == "differs"].to_dict("records"):
        text += f"\n{row['item']}: printed {row['published']:g}, ours {row['ours']:g}"
    return text


def _draw_values(axes: Axes, values: pd.DataFrame) -> None:
    lines = list(grouped(values))
    for place, (_, row) in enumerate(lines):
        if row is not None:
            accepted = row["allowed"] / independent_error(row["mcse"], row["their_error"])
            axes.barh(place, 2 * accepted, left=-accepted, height=1.0, color=ACCEPTED, lw=0)
            face = "white" if row["on_edge"] else COLOURS[row["verdict"]]
            _mark(axes, row["z"], place, COLOURS[row["verdict"]], face)
    _finish(
        axes,
        lines,
        "Published values (hollow: another root seed may decide otherwise)",
        "ours - published, in standard errors of both (grey: match)",
    )


def _draw_claims(axes: Axes, claims: pd.DataFrame, parts: pd.DataFrame, tolerance: float) -> None:
    lines = list(grouped(claims))
    axes.axvspan(-tolerance, tolerance, color=ACCEPTED, lw=0, zorder=0)
    for place, (_, row) in enumerate(lines):
        if row is None:
            continue
        of_claim = parts.loc[parts["item"] == row["item"]]
        finite = np.isfinite(of_claim["margin"].to_numpy())
        for part in of_claim.loc[finite].to_dict("records"):
            colour = COLOURS[part["verdict"]]
            _mark(axes, -part["margin"], place, colour, colour, "|", size=7)
        counts = of_claim.loc[~finite, "verdict"].value_counts()
        text = ", ".join(f"{count} {verdict}" for verdict, count in counts.items())
        axes.annotate(
            f"bounds: {text}" if text else "",
            (LARGEST + 0.9, place),
            va="center",
            fontsize=6.5,
            annotation_clip=False,
        )
    _finish(
        axes,
        lines,
        "Claims, every comparison",
        "in favour, in standard errors (grey: undecided; right: numbers against bounds)",
    )


def _mark(
    axes: Axes, z: float, place: int, colour: str, face: str, marker: str = "o", size: float = 5
) -> None:
    """One number; what is farther than `LARGEST` is an arrow that points there."""
    if abs(z) > LARGEST:
        marker, size = (">" if z > 0 else "<"), 5
    look: dict[str, Any] = dict(color=colour, markerfacecolor=face, ms=size, mew=1.3, clip_on=False)
    axes.plot(np.clip(z, -LARGEST, LARGEST), place, marker, **look)


def _finish(
    axes: Axes, lines: Sequence[tuple[str, dict[Any, Any] | None]], title: str, across: str
) -> None:
    axes.axvline(0, color="black", lw=0.8)
    words = [name if row is None else f"{name}: {row['verdict']}" for name, row in lines]
    axes.set_yticks(np.arange(len(lines)), words, fontsize=7)
    for label, (_, row) in zip(axes.get_yticklabels(), lines, strict=True):
        label.set(color="black" if row is None else COLOURS[row["verdict"]])
        label.set_fontweight("bold" if row is None else "normal")
    axes.tick_params(axis="y", length=0)
    axes.set(xlim=(-LARGEST - 0.3, LARGEST + 0.3), ylim=(len(lines) - 0.4, -0.6))
    axes.set_title(title, fontsize=9)
    axes.set_xlabel(across, fontsize=8)
    axes.grid(False, axis="y")
