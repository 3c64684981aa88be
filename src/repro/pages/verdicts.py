"""The verdicts for a reader: tally, Markdown page, and the first page of Snakemake's report."""

import re
from collections.abc import Iterator

import numpy as np
import pandas as pd

from repro.atomic import atomic_write
from repro.tables.csv_file import write_csv
from repro.verdicts.published import REPRODUCED, VERDICTS, diff

HEADS = {
    "value": ("item", "published", "ours", "standard error (ours, theirs)", "z"),
    "claim": ("item", "claim", "evidence"),
}
TITLE = "Published against reproduced"


def write_diff(
    papers: dict[str, dict], tolerance: float, csv: str, markdown: str, report: str, tally: str
) -> None:
    """Write the diff of all papers (see `diff`) as CSV, Markdown, reStructuredText, and a tally."""
    table = diff(papers, tolerance)
    write_csv(table, csv)
    texts = {
        markdown: markdown_page(table),
        report: report_page(table),
        tally: "\n".join(tally_lines(table)) + "\n",
    }
    for path, text in texts.items():
        with atomic_write(path) as part:
            part.write_text(text)


def tally_lines(table: pd.DataFrame) -> list[str]:
    """One line a paper: how many published values match, how many claims hold."""
    lines = []
    for paper, rows in table.groupby("paper", sort=False):
        said = []
        for kind, verdicts in VERDICTS.items():
            found = rows.loc[rows["kind"] == kind, "verdict"]
            counts = ", ".join(f"{(found == v).sum()} {v}" for v in verdicts)
            said.append(f"{len(found)} {kind}s: {counts}")
        surprises = int((~rows["as_expected"]).sum())
        lines.append(f"{paper}: {'; '.join(said)}; {surprises} not as expected")
    return lines


def sections(table: pd.DataFrame) -> Iterator[tuple[str, str, tuple[str, ...], list[list[str]]]]:
    """Paper, kind, head and rows of each table; what does not reproduce stands on top."""
    for paper, rows in table.groupby("paper", sort=False):
        ranked = rows.assign(rank=rows["verdict"].isin(REPRODUCED))
        ranked = ranked.sort_values("rank", kind="stable")
        for kind, head in HEADS.items():
            of_kind = ranked[ranked["kind"] == kind]
            cells = [[*_cells(row), row.verdict, row.reason] for row in of_kind.itertuples()]
            if cells:
                yield paper, kind, (*head, "verdict", "reason"), cells


def _cells(row) -> list[str]:
    if row.kind == "claim":
        return [row.item, row.statement, row.evidence]
    errors = f"{row.mcse:.2g}, {row.their_error:.2g}"
    z = "" if np.isnan(row.z) else f"{row.z:+.1f}"
    return [row.item, f"{row.published:g}", f"{row.ours:.4g}", errors, z]


def markdown_page(table: pd.DataFrame) -> str:
    """The page results/diff.md."""
    text = [f"# {TITLE}", "", *(f"- {line}" for line in tally_lines(table)), ""]
    for paper, kind, head, rows in sections(table):
        text += [f"## {paper}: {kind}s", ""]
        text += [f"| {' | '.join(cells)} |" for cells in (head, ["---"] * len(head), *rows)]
        text.append("")
    return "\n".join(text)


def report_page(table: pd.DataFrame) -> str:
    """The first page of the report; the pictures of the verdicts are links into it."""
    text = [TITLE, "=" * len(TITLE), ""]
    text += [f"- {_escaped(line)}" for line in tally_lines(table)]
    for paper, kind, head, rows in sections(table):
        title = f"{_escaped(paper)}: {kind}s"
        text += ["", title, "-" * len(title), ""]
        text += [".. list-table::", "   :header-rows: 1", ""]
        for cells in (head, *rows):
            marks = ("   * -", *["     -"] * (len(cells) - 1))
            text += [f"{m} {_escaped(c)}".rstrip() for m, c in zip(marks, cells, strict=True)]
    return "\n".join(text) + "\n"


def _escaped(text: str) -> str:
    return re.sub(r"([\\*`|_{}])", r"\\\1", text)
