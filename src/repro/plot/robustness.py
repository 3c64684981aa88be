"""Every verdict of a paper under every reading of what the paper leaves open."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from repro.plot import style
from repro.plot.style import WIDTH
from repro.plot.verdicts import BAD, in_words
from repro.tables.results import Results
from repro.verdicts.standing import NOT_RUN, OPPOSITE, STANDINGS, too_few_trials

NAMES, ROW, HEADING = 2.9, 0.19, 1.5  # inches: names of the verdicts, a row, names of readings
MOST = 99  # standard errors that a cell has room for
CELL = "In a cell: standard errors in favour of a claim, or of a value from the printed one."
SAME, FEW, OTHER, REVERSED = "#C7E9DF", "#F3F0E2", "#EDBB55", BAD


def robustness(results: Results, paper: str) -> Figure:
    """A row a verdict, the most fragile first; a column a reading; blank where it is not run.

    A cell is coloured by the verdict against the ordinary one, and has its margin.
    """
    diff, under = results.diff(), results.robustness()
    diff = diff.loc[diff["paper"] == paper].fillna({"standing": ""})
    under = under.loc[(under["paper"] == paper) & (under["verdict"] != NOT_RUN)]
    rank = {name: place for place, name in enumerate(reversed(STANDINGS))}
    judged = diff.loc[diff["standing"].str.partition(" ")[0].isin(STANDINGS)]
    judged = judged.assign(
        rank=[rank[text.partition(" ")[0]] for text in judged["standing"]],
        same=[
            (under.loc[under["item"] == item, "verdict"] == verdict).mean()
            for item, verdict in zip(judged["item"], judged["verdict"], strict=True)
        ],
    )
    rows = judged.sort_values(["rank", "same"], kind="stable").to_dict("records")
    readings = list(dict.fromkeys(under["reading"]))
    if not rows:
        drawn, axes = style.figure(size=(WIDTH, 1))
        axes.axis("off")
        axes.text(0, 0.5, "No other reading of this paper runs.")
        return drawn
    drawn, axes = style.figure(size=(WIDTH, HEADING + ROW * len(rows) + 0.6))
    cells = {(cell["item"], cell["reading"]): cell for cell in under.to_dict("records")}
    for place, row in enumerate(rows):
        _draw_row(axes, place, row, [cells.get((row["item"], name)) for name in readings])
    words = [f"{in_words(row['item'])}: {row['verdict']}" for row in rows]
    axes.set_yticks(np.arange(len(rows)), words, fontsize=7)
    short = [name.removeprefix("reading-") for name in readings]
    axes.set_xticks(
        np.arange(len(readings)), short, fontsize=7, rotation=60, ha="left", rotation_mode="anchor"
    )
    axes.xaxis.tick_top()
    axes.tick_params(length=0, pad=1)
    axes.set(xlim=(-0.5, max(len(readings), 6) - 0.5), ylim=(len(rows) - 0.5, -0.5))
    axes.spines[:].set_visible(False)
    axes.set_axisbelow(True)
    axes.grid(True, color="0.92", alpha=1.0, lw=0.6)
    _legend(drawn, len(diff) - len(judged))
    return drawn


def _draw_row(
    axes: Axes, place: int, row: Mapping[Any, Any], cells: Sequence[Mapping[Any, Any] | None]
) -> None:
    for column, cell in enumerate(cells):
        if cell is None:
            continue
        colour = _colour(row["verdict"], cell["verdict"], cell["margin"])
        axes.add_patch(
            Rectangle((column - 0.46, place - 0.44), 0.92, 0.88, color=colour, lw=0, zorder=2)
        )
        axes.annotate(
            _margin(row["kind"], cell["margin"]),
            (column, place),
            ha="center",
            va="center",
            fontsize=6,
            color="white" if colour == REVERSED else "0.25",
        )


def _colour(verdict: str, under: str, margin: float) -> str:
    if under == verdict:
        return SAME
    if under == OPPOSITE.get(verdict):
        return REVERSED
    return FEW if too_few_trials(verdict, under, margin) else OTHER


def _margin(kind: str, margin: float) -> str:
    """Standard errors in favour of a claim, or of a value from the printed one."""
    if not np.isfinite(margin):
        return ""
    shown = abs(margin) if kind == "value" else -margin
    return f"{np.clip(shown, -MOST, MOST):.{0 if abs(shown) >= 9.95 else 1}f}"


def _legend(drawn: Figure, without: int) -> None:
    handles = [
        Patch(color=SAME, label="as in the ordinary run"),
        Patch(color=FEW, label="too few trials to decide"),
        Patch(color=OTHER, label="another verdict"),
        Patch(color=REVERSED, label="the opposite one"),
    ]
    drawn.legend(
        handles=handles,
        ncols=4,
        fontsize=7.5,
        loc="outside lower left",
        title=CELL + f"\nNot shown: {without} verdicts that no reading concerns." * (without > 0),
        title_fontsize=7.5,
        alignment="left",
    )
