"""Tables of the Markdown pages."""

from collections.abc import Iterable, Sequence

from tabulate import tabulate


def markdown_table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table of texts, with what would end a cell escaped."""
    cells = [[_cell(text) for text in row] for row in rows]
    # The texts are formatted already: 2.20 must not become 2.2.
    return tabulate(cells, [_cell(text) for text in head], tablefmt="github", disable_numparse=True)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", r"\|")
