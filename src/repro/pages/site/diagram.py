"""Block diagrams of the papers' models, from blocks of text in docs/papers/, as plain SVG.

A block of code named `diagram` has a line for each box, from left to right:
name | line of text | line of text ... | > what enters it from above
with a space on both sides of each bar.
"""

import re
from collections.abc import Iterator
from html import escape
from typing import NamedTuple

from repro.errors import ReproError
from repro.pages.site.fragments import raw, tag

BLOCK = re.compile(r"^```diagram\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LETTER, GAP, TOP, LINE = 7.0, 34, 58, 19  # px: width of a letter, of an arrow; heights
ENTERS = ">"


class Box(NamedTuple):
    """One box of a chain."""

    name: str
    lines: list[str]
    enters: str  # what comes in from above; empty if nothing does

    @property
    def width(self) -> float:
        """In px."""
        longest = max(map(len, [self.name, *self.lines]))
        return max(84.0, 20 + LETTER * longest, 16 + 6.6 * len(self.enters))


def with_diagrams(text: str, where: str) -> str:
    """A Markdown text with its diagrams drawn. Raises ReproError for a diagram without a box."""
    return BLOCK.sub(lambda match: raw(diagram(match[1], where)), text)


def diagram(description: str, where: str) -> str:
    """The SVG of a description, in a box that scrolls by itself."""
    boxes = [_box(line) for line in description.splitlines() if line.strip()]
    if not boxes:
        raise ReproError(f"{where}: a diagram has no line; write: name | line of text")
    height = 26 + LINE * max(len(box.lines) for box in boxes)
    width = sum(box.width for box in boxes) + GAP * (len(boxes) - 1) + 4
    words = "; ".join(f"{box.name}: {', '.join(box.lines)}" for box in boxes)
    drawn = tag(
        "svg",
        "".join(_drawn(boxes, height)),
        viewBox=f"0 0 {width:.0f} {TOP + height + 4}",
        width=f"{width:.0f}",
        role="img",
        aria_label=words,
    )
    return tag("div", drawn, class_="wide diagram")


def _box(line: str) -> Box:
    name, *rest = (part.strip() for part in line.split(" | "))
    enters = [part.removeprefix(ENTERS).strip() for part in rest if part.startswith(ENTERS)]
    return Box(name, [part for part in rest if not part.startswith(ENTERS)], ", ".join(enters))


def _drawn(boxes: list[Box], height: float) -> Iterator[str]:
    left = 2.0
    for place, box in enumerate(boxes):
        middle = left + box.width / 2
        yield (
            f'<rect x="{left:.0f}" y="{TOP}" width="{box.width:.0f}" height="{height}" rx="6" '
            'class="box"></rect>'
        )
        yield _text(middle, TOP + 19, box.name, "name")
        for number, line in enumerate(box.lines, start=1):
            yield _text(middle, TOP + 19 + LINE * number, line, "line")
        if box.enters:
            yield _text(middle, 14, box.enters, "enters")
            yield _arrow(middle, 20, middle, TOP)
        left += box.width
        if place < len(boxes) - 1:
            yield _arrow(left, TOP + height / 2, left + GAP, TOP + height / 2)
        left += GAP


def _text(x: float, y: float, text: str, look: str) -> str:
    return f'<text x="{x:.0f}" y="{y:.0f}" class="{look}">{escape(text)}</text>'


def _arrow(x1: float, y1: float, x2: float, y2: float) -> str:
    """A line with its head, to the right or down."""
    right = x2 > x1
    head = (
        f"{x2},{y2} {x2 - 7},{y2 - 4} {x2 - 7},{y2 + 4}"
        if right
        else f"{x2},{y2} {x2 - 4},{y2 - 7} {x2 + 4},{y2 - 7}"
    )
    line = f'<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" class="arrow"></line>'
    return f'{line}<polygon points="{head}" class="head"></polygon>'
