"""Rows of counts as bars, and the colours of what is counted."""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.patches import Patch

from repro.plot.verdicts import COLOURS

INITIALS = re.compile(r"\b[A-Z]\.(?:[- ]?[A-Z]\.)* *")
# On light ones black is read.
OF_VERDICTS = COLOURS | {"undecided": "#F2C46D"}
DARK = {"#009E73", "#D55E00", "#08519C", "#54278F"}
ROOM = 0.04  # of the axis, for a number in a bar


class Bar(NamedTuple):
    """A row: its name, and how many of each; None for a heading."""

    name: str
    counts: dict[str, int] | None = None


def counted(found: Iterable[str], names: Iterable[str]) -> dict[str, int]:
    """How many there are of each name."""
    every = list(found)
    return {name: every.count(name) for name in names}


def without_initials(authors: str) -> str:
    """Family names and year."""
    return INITIALS.sub("", authors)


def draw_bars(
    axes: Axes,
    bars: Sequence[Bar],
    colours: Mapping[str, str],
    size: float = 8,
    beside: bool = False,
) -> None:
    """The bars top down, with their numbers; `beside` has those of a bar without room in words."""
    widest = max(sum((bar.counts or {}).values()) for bar in bars) or 1
    for place, (_, counts) in enumerate(bars):
        there = {name: count for name, count in (counts or {}).items() if count}
        fits = all(count > ROOM * widest for count in there.values())
        left = 0
        for name, count in there.items():
            colour = colours[name]
            axes.barh(place, count, left=left, color=colour, edgecolor="white", height=0.82)
            if fits or (not beside and count > ROOM * widest):
                axes.annotate(
                    f"{count}",
                    (left + count / 2, place),
                    ha="center",
                    va="center",
                    fontsize=size,
                    color="white" if colour in DARK else "black",
                )
            left += count
        if beside and not fits:
            axes.annotate(
                ", ".join(f"{count} {name}" for name, count in there.items()),
                (left, place),
                xytext=(4, 0),
                textcoords="offset points",
                va="center",
                fontsize=size,
            )
    axes.set_yticks(range(len(bars)), [bar.name for bar in bars], fontsize=size)
    # Labels of an axis that shares another's are not drawn.
    for label, bar in zip(axes.get_yticklabels(), bars, strict=False):
        label.set_fontweight("bold" if bar.counts is None else "normal")
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(len(bars) - 0.4, -0.6)
    axes.grid(False)


def patches(colours: Mapping[str, str], words: Mapping[str, str]) -> list[Patch]:
    """Handles of a legend: `words` has the label of each name that has one."""
    return [Patch(color=colours[name], label=label) for name, label in words.items()]
