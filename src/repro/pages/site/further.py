"""Results beside the verdicts, where a run has them: consistency, convergence and others."""

from collections.abc import Iterator
from html import escape
from pathlib import Path

import pandas as pd

from repro.pages.site.content import Content
from repro.pages.site.fragments import details, number, raw, table
from repro.pages.site.gallery_pages import figure

# Folder of results, and figure of a paper -> what it shows.
KINDS = {
    "consistency": "Consistency: do the errors agree with the variances that the filters claim?",
    "bounds": "Bounds: how far is each filter from the best possible?",
    "convergence": "Convergence: do more particles, or shorter steps, change the order?",
    "mismatch": "Mismatch: what do wrong parameters cost a filter?",
    "tails": "Tails: what do the worst runs do?",
    "cost": "Cost: error against time.",
}
MOST = 400  # rows shown of a table; the file has all


def further_results(content: Content, paper: str) -> list[str]:
    """Pictures and tables of a paper that there are."""
    text = []
    for kind, title in KINDS.items():
        parts = [*figure(content, paper, kind, "../"), *_summary(content, kind, paper)]
        parts += _tables(content, kind, paper)
        if parts:
            text += [f"## {title}\n", *parts]
    return text


def _summary(content: Content, kind: str, paper: str) -> Iterator[str]:
    """The sentences on a paper that a run has written."""
    file = content.layout.root / kind / f"{paper}.md"
    if file.exists():
        yield f"{file.read_text(encoding='utf-8')}\n"


def _tables(content: Content, kind: str, paper: str) -> Iterator[str]:
    studies = list(content.papers[paper].studies)
    for file, rows in _read(content, kind):
        own = file.stem == paper or file.stem in studies
        if not own and "study" in rows:
            rows, own = rows.loc[rows["study"].isin(studies)], True
        elif not own and "paper" in rows:
            rows, own = rows.loc[rows["paper"] == paper], True
        if own and len(rows):
            yield _shown(content, file, rows)


def rows_about(content: Content, column: str, value: str) -> Iterator[str]:
    """Rows of all of these tables whose column has a value: those of a filter, or of a study."""
    for kind, title in KINDS.items():
        found = []
        for file, rows in _read(content, kind):
            if column == "study" and file.stem == value:
                found.append(_shown(content, file, rows))
            elif column in rows:
                mine = rows.loc[rows[column] == value]
                found += [_shown(content, file, mine)] if len(mine) else []
        if found:
            yield f"## {title}\n"
            yield from found


def _read(content: Content, kind: str) -> Iterator[tuple[Path, pd.DataFrame]]:
    root = content.layout.root
    single = [root / f"{kind}.csv"] if (root / f"{kind}.csv").exists() else []
    for file in [*single, *sorted((root / kind).glob("**/*.csv"))]:
        yield file, pd.read_csv(file)


def _shown(content: Content, file: Path, rows: pd.DataFrame) -> str:
    rows = rows.dropna(axis="columns", how="all").head(MOST)
    cells = [[_cell(value) for value in row] for row in rows.itertuples(index=False)]
    name = file.relative_to(content.layout.root)
    return raw(details(f"{len(rows)} rows of {name}", table(list(rows), cells, class_="sortable")))


def _cell(value: object) -> str:
    return number(value) if isinstance(value, int | float) else escape(str(value))
