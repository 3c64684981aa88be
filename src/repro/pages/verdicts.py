"""The verdicts for a reader: tally, Markdown page, and the first page of Snakemake's report."""

import string
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from repro.atomic import atomic_write
from repro.pages.markdown import markdown_line, markdown_table
from repro.tables.csv_file import write_csv
from repro.verdicts.published import REPRODUCED, VERDICTS, diff

HEADS = {
    "value": ("item", "published", "ours", "standard error (ours, theirs)", "z", "allowed"),
    "claim": ("item", "claim", "evidence"),
}
TITLE = "Published against reproduced"


def write_diff(
    papers: Mapping[str, Mapping[str, Any]],
    tolerance: float,
    csv: str,
    robustness: str,
    markdown: str,
    report: str,
    tally: str,
) -> None:
    """Write the diff of all papers (see `diff`) as CSV, Markdown, reStructuredText, and a tally.

    The verdicts under every reading go to `robustness`, all papers in one table.
    """
    table = diff(papers, tolerance)
    write_csv(table, csv)
    write_csv(pd.concat([pd.read_csv(p["robustness"]) for p in papers.values()]), robustness)
    texts = {
        markdown: markdown_page(table),
        report: report_page(table),
        tally: "\n".join(tally_lines(table)) + "\n",
    }
    for path, text in texts.items():
        with atomic_write(path) as part:
            part.write_text(text, encoding="utf-8")


def tally_lines(table: pd.DataFrame) -> list[str]:
    """One line a paper: how many published values match, how many claims hold."""
    lines = []
    for paper, rows in table.groupby("paper", sort=False):
        tallies = []
        for kind, verdicts in VERDICTS.items():
            of_kind = list(rows.loc[rows["kind"] == kind, "verdict"])
            counts = ", ".join(f"{of_kind.count(verdict)} {verdict}" for verdict in verdicts)
            tallies.append(f"{len(of_kind)} {kind}s: {counts}")
        unexpected = list(rows["as_expected"]).count(False)
        edge = list(rows["on_edge"]).count(True)
        lines.append(
            f"{paper}: {'; '.join(tallies)}; {unexpected} not as expected, {edge} on the edge"
        )
    return lines


EDGE = " (on the edge)"  # another root seed may give another verdict


class Section(NamedTuple):
    """A table of the pages: the values, or the claims, of a paper."""

    title: str
    head: tuple[str, ...]
    rows: list[list[str]]


def sections(table: pd.DataFrame) -> Iterator[Section]:
    """The tables of all papers; in each, what does not reproduce comes first."""
    for paper, rows in table.groupby("paper", sort=False):
        ranked = rows.assign(rank=rows["verdict"].isin(REPRODUCED))
        ranked = ranked.sort_values("rank", kind="stable").to_dict("records")
        for kind, head in HEADS.items():
            cells = [
                [*_cells(row), row["class"], _verdict(row), row["standing"], row["reason"]]
                for row in ranked
                if row["kind"] == kind
            ]
            if cells:
                yield Section(
                    f"{paper}: {kind}s",
                    (*head, "evidence is", "verdict", "readings", "reason"),
                    cells,
                )


def _verdict(row: Mapping[Any, Any]) -> str:
    return row["verdict"] + EDGE * bool(row["on_edge"])


def _cells(row: Mapping[Any, Any]) -> list[str]:
    if row["kind"] == "claim":
        return [row["item"], row["statement"], row["evidence"]]
    errors = f"{row['mcse']:.2g}, {row['their_error']:.2g}"
    z = "" if np.isnan(row["z"]) else f"{row['z']:+.1f}"
    allowed = "" if np.isnan(row["allowed_percent"]) else f"{row['allowed_percent']:.3g} %"
    return [row["item"], f"{row['published']:g}", f"{row['ours']:.4g}", errors, z, allowed]


def markdown_page(table: pd.DataFrame) -> str:
    """The page results/diff.md."""
    text = [f"# {TITLE}", "", *(f"- {line}" for line in tally_lines(table)), ""]
    for section in sections(table):
        text += [
            f"## {markdown_line(section.title)}",
            "",
            markdown_table(section.head, section.rows),
            "",
        ]
    return "\n".join(text)


def report_page(table: pd.DataFrame) -> str:
    """The first page of the report; the pictures of the verdicts are links into it."""
    text = [TITLE, "=" * len(TITLE), ""]
    text += [f"- {_escaped(line)}" for line in tally_lines(table)]
    for section in sections(table):
        title = _escaped(section.title)
        text += ["", title, "-" * len(title), ""]
        text += [".. list-table::", "   :header-rows: 1", ""]
        for cells in (section.head, *section.rows):
            marks = ("   * -", *["     -"] * (len(cells) - 1))
            text += [f"{m} {_escaped(c)}".rstrip() for m, c in zip(marks, cells, strict=True)]
    return "\n".join(text) + "\n"


def _escaped(text: str) -> str:
    """A text in one line, in which nothing means anything to reStructuredText or to Jinja."""
    shown = (f"\\{c}" if c in string.punctuation else c for c in " ".join(text.split()))
    return "".join(shown)
