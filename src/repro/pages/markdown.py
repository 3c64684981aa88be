"""Texts of others in Markdown pages: shown as they are, whatever is in them."""

import re
from collections.abc import Iterable, Sequence

from tabulate import tabulate

TAG = re.compile(r"<(?=[A-Za-z/!?])")  # a < that begins no tag stays as it is
LINK = "]("
BLOCK = re.compile(r"^(?=[#>+*=~`|-])")  # what begins a heading, a list, a quotation ...


def markdown_table(
    head: Sequence[str], rows: Iterable[Sequence[str]], sides: Sequence[str] | None = None
) -> str:
    """A table of texts; `sides` are those that the columns are aligned to, left or right."""
    cells = [[markdown_cell(text) for text in row] for row in rows]
    # The texts are formatted already: 2.20 must not become 2.2.
    return tabulate(
        cells,
        [markdown_cell(text) for text in head],
        tablefmt="github",
        disable_numparse=True,
        colalign=sides,
    )


def markdown_line(text: str) -> str:
    """A text as a paragraph or heading of its own."""
    return BLOCK.sub(r"\\", _shown(text))


def markdown_cell(text: str) -> str:
    """A text as a cell of a table."""
    return _shown(text).replace("|", r"\|")


def _shown(text: str) -> str:
    """A text in one line without a tag, a link, or what a terminal would obey."""
    line = " ".join(text.split()).replace("\\", "\\\\").replace(LINK, r"]\(")
    return TAG.sub("&lt;", "".join(c if c.isprintable() else repr(c)[1:-1] for c in line))
