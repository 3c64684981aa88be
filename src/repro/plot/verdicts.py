"""Verdicts at a glance: every published value and every comparison behind the claims of a paper."""

from collections.abc import Callable, Sequence
from textwrap import fill
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.plot import style
from repro.plot.style import WIDTH
from repro.statistics.paired import independent_error
from repro.tables.results import Results
from repro.verdicts.published import CLASSES, VERDICTS

GOOD, OPEN, BAD = "#009E73", "#B97700", "#D55E00"
COLOURS = {"match": GOOD, "holds": GOOD, "undecided": OPEN, "differs": BAD, "fails": BAD}
LARGEST = 12.0  # standard errors drawn; what is farther is an arrow at the edge
ROW, HEADING = 0.155, 0.85  # inches: a line of text; title and axis of a panel
LETTERS = 58  # of a statement on a line
ACCEPTED = "0.88"  # grey of where a value matches, or a comparison is undecided; the only one


class Line(NamedTuple):
    """A row of a panel: its text, where it is, and what is drawn; nothing for a class's name."""

    text: str
    place: float
    height: int
    row: dict[Any, Any] | None


class Panel(NamedTuple):
    """A part of the picture, of one kind of evidence."""

    title: str
    lines: list[Line]
    draw: Callable[[Axes, Line], None]
    across: str  # label of the axis in standard errors; empty where there is none


def verdicts(results: Results, paper: str) -> Figure:
    """Values in standard errors from the printed ones; comparisons of the claims; exact checks.

    What has no standard error to scale by, an equality or a count, has a panel of words.
    """
    diff, parts = results.diff(), results.claims(paper)
    diff = diff.loc[diff["paper"] == paper]
    values, claims = diff.loc[diff["kind"] == "value"], diff.loc[diff["kind"] == "claim"]
    exact_value = ~np.isfinite(values["z"].to_numpy())
    compared = set(parts.loc[np.isfinite(parts["margin"].to_numpy()), "item"])
    exact_claim = ~claims["item"].isin(compared)

    def compare(axes: Axes, line: Line) -> None:
        _comparisons(axes, line, parts, results.tolerance)

    panels = [
        Panel(
            "Published values (hollow: on the edge)",
            _lines(values.loc[~exact_value]),
            _value,
            "ours - published, in standard errors of both (grey: match)",
        ),
        Panel("Published values, exact", _lines(values.loc[exact_value]), _equality, ""),
        Panel(
            "Claims, a mark for each comparison",
            _lines(claims.loc[~exact_claim]),
            compare,
            "in favour of the claim, in standard errors (grey: undecided)",
        ),
        Panel(
            "Claims that exact checks decide",
            _lines(claims.loc[exact_claim]),
            lambda axes, line: _checks(axes, line, parts),
            "",
        ),
    ]
    panels = [panel for panel in panels if panel.lines]
    heights = [ROW * _end(p.lines) + (HEADING if p.across else HEADING / 2) for p in panels]
    drawn, grid = style.figure(
        len(panels),
        1,
        size=(WIDTH, sum(heights)),
        squeeze=False,
        gridspec_kw={"height_ratios": heights},
    )
    for axes, panel in zip(grid.flat, panels, strict=True):
        _draw(axes, panel)
    return drawn


def in_words(item: str) -> str:
    """A claim's name in words; the names of values are words already."""
    return item if " " in item else item.replace("-", " ")


def _lines(rows: pd.DataFrame) -> list[Line]:
    """Top down: the name of a class of evidence, then each of its rows."""
    lines: list[Line] = []

    def add(text: str, row: dict[Any, Any] | None) -> None:
        height = text.count("\n") + 1
        lines.append(Line(text, _end(lines) + height / 2, height, row))

    for name in CLASSES:
        of_class = rows.loc[rows["class"] == name].to_dict("records")
        if of_class:
            add(name, None)
        for row in of_class:
            stated = row["statement"] if isinstance(row["statement"], str) else row["item"]
            add(fill(stated, LETTERS), row)
    return lines


def _end(lines: Sequence[Line]) -> float:
    return lines[-1].place + lines[-1].height / 2 if lines else 0.0


def _draw(axes: Axes, panel: Panel) -> None:
    axes.set(xlim=(-LARGEST - 0.3, LARGEST + 0.3), ylim=(_end(panel.lines), 0))
    axes.grid(False)
    axes.tick_params(axis="y", length=0)
    axes.set_yticks([line.place for line in panel.lines], [line.text for line in panel.lines])
    for label, line in zip(axes.get_yticklabels(), panel.lines, strict=True):
        label.set(fontsize=7.5, fontweight="bold" if line.row is None else "normal")
        label.set_linespacing(1.0)
    axes.set_title(panel.title, fontsize=9, loc="left", fontweight="bold")
    if panel.across:
        axes.axvline(0, color="black", lw=0.8)
        axes.set_xlabel(panel.across, fontsize=8)
    else:
        axes.set_xticks([])
        axes.spines[:].set_visible(False)
    for line in panel.lines:
        if line.row is not None:
            panel.draw(axes, line)


def _value(axes: Axes, line: Line) -> None:
    row = line.row or {}
    accepted = row["allowed"] / independent_error(row["mcse"], row["their_error"])
    _accept(axes, line, accepted)
    colour = COLOURS[row["verdict"]]
    _mark(axes, row["z"], line.place, colour, "white" if row["on_edge"] else colour)
    _say(axes, LARGEST + 0.9, line.place, row["verdict"], row["verdict"])


def _equality(axes: Axes, line: Line) -> None:
    row = line.row or {}
    text = f"{row['verdict']}: printed {row['published']:g}, ours {row['ours']:.4g}"
    _say(axes, -LARGEST, line.place, text, row["verdict"])


def _comparisons(axes: Axes, line: Line, parts: pd.DataFrame, tolerance: float) -> None:
    row = line.row or {}
    _accept(axes, line, tolerance)
    of_claim = parts.loc[parts["item"] == row["item"]]
    finite = np.isfinite(of_claim["margin"].to_numpy())
    for part in of_claim.loc[finite].to_dict("records"):
        colour = COLOURS[part["verdict"]]
        _mark(axes, -part["margin"], line.place, colour, colour, "|", size=7)
    exact = _counted(of_claim.loc[~finite, "verdict"])
    text = f"{row['verdict']}; exact: {exact}" if exact else row["verdict"]
    _say(axes, LARGEST + 0.9, line.place, text, row["verdict"])


def _checks(axes: Axes, line: Line, parts: pd.DataFrame) -> None:
    row = line.row or {}
    counts = _counted(parts.loc[parts["item"] == row["item"], "verdict"])
    _say(axes, -LARGEST, line.place, f"{row['verdict']} ({counts})", row["verdict"])


def _counted(found: pd.Series) -> str:
    """How many comparisons have each verdict."""
    counts = found.value_counts()
    return ", ".join(f"{counts[name]} {name}" for name in VERDICTS["claim"] if name in counts)


def _accept(axes: Axes, line: Line, half: float) -> None:
    axes.barh(line.place, 2 * half, left=-half, height=line.height, color=ACCEPTED, lw=0, zorder=0)


def _say(axes: Axes, x: float, place: float, text: str, verdict: str) -> None:
    axes.annotate(
        text, (x, place), va="center", fontsize=7.5, color=COLOURS[verdict], annotation_clip=False
    )


def _mark(
    axes: Axes, z: float, place: float, colour: str, face: str, marker: str = "o", size: float = 5
) -> None:
    """One number; what is farther than `LARGEST` is an arrow that points there."""
    if abs(z) > LARGEST:
        marker, size = (">" if z > 0 else "<"), 5
    look: dict[str, Any] = dict(color=colour, markerfacecolor=face, ms=size, mew=1.3, clip_on=False)
    axes.plot(np.clip(z, -LARGEST, LARGEST), place, marker, **look)
