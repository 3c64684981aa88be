"""The verdicts as one HTML file that stands alone: an item of Snakemake's report."""

from collections.abc import Iterable, Sequence
from html import escape

STYLE = """\
:root { color-scheme: light dark; }
body { font: 0.9rem/1.4 sans-serif; margin: 1rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; }
th, td { padding: 0.3rem 0.6rem; text-align: left; vertical-align: top; border-bottom: 1px solid; }
"""

Section = tuple[str, Sequence[str], Iterable[Sequence[str]]]  # title, head, rows


def verdict_tables(title: str, lines: Iterable[str], sections: Iterable[Section]) -> str:
    """The page: a list of lines, then a table under each heading; texts are shown as they are."""
    text = [f"<h1>{escape(title)}</h1>", "<ul>"]
    text += [f"<li>{escape(line)}</li>" for line in lines] + ["</ul>"]
    for heading, head, rows in sections:
        text += [f"<h2>{escape(heading)}</h2>", '<div class="wide"><table>', _row(head, "th")]
        text += [*(_row(row, "td") for row in rows), "</table></div>"]
    head = (
        f'<head><meta charset="utf-8"><title>{escape(title)}</title><style>{STYLE}</style></head>'
    )
    return (
        f'<!doctype html>\n<html lang="en">{head}\n<body>\n'
        + "\n".join(text)
        + "\n</body></html>\n"
    )


def _row(cells: Iterable[str], tag: str) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"
