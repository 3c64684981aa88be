"""The verdicts for a reader: tally, Markdown page, and the first page of Snakemake's report."""

import string
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from repro.atomic import atomic_write
from repro.pages.markdown import markdown_line, markdown_table
from repro.pages.verdict_tables import verdict_tables
from repro.tables.csv_file import write_csv
from repro.verdicts.published import CLASSES, REPRODUCED, VERDICTS, diff
from repro.verdicts.standing import NEEDS_NONE, STANDINGS

HEADS = {
    "value": ("item", "published", "ours", "standard error (ours, theirs)", "z", "allowed"),
    "claim": ("item", "claim", "evidence"),
}
JOINT_HEAD = ("table", "cells", "trials", "chi-square", "p-value", "farthest cell", "its z")
TITLE = "Published against reproduced"
NONE = "none printed"
WHERE = "Every row, with evidence, readings and reason: Verdicts, in the menu."
WITHOUT = "without reading"  # no reading of the paper concerns the verdict


def write_diff(
    papers: Mapping[str, Mapping[str, Any]],
    tolerance: float,
    csv: str,
    robustness: str,
    markdown: str,
    html: str,
    report: str,
    tally: str,
) -> None:
    """Write the diff of all papers (see `diff`) as CSV, Markdown and HTML, and a tally.

    `report` is the first page of the report, in reStructuredText.
    The verdicts under every reading go to `robustness`, all papers in one table.
    """
    table = diff(papers, tolerance)
    write_csv(table, csv)
    under = _all(papers, "robustness")
    write_csv(under.loc[under["verdict"] != NEEDS_NONE], robustness)
    joint = _all(papers, "joint")
    texts = {
        markdown: markdown_page(table, joint),
        html: verdict_tables(TITLE, tally_lines(table), sections(table, joint)),
        report: report_page(table),
        tally: "\n".join(tally_lines(table)) + "\n",
    }
    for path, text in texts.items():
        with atomic_write(path) as part:
            part.write_text(text, encoding="utf-8")


def _all(papers: Mapping[str, Mapping[str, Any]], kind: str) -> pd.DataFrame:
    return pd.concat([pd.read_csv(files[kind]) for files in papers.values()])


def tally_lines(table: pd.DataFrame) -> list[str]:
    """Verdicts of each paper by what their evidence is worth, and what another seed may change."""
    lines = []
    for paper, rows in table.groupby("paper", sort=False):
        standings = []
        for kind, verdicts in VERDICTS.items():
            of_kind = rows.loc[rows["kind"] == kind]
            by_class = [
                f"{name} {counts(of_class['verdict'], verdicts)}"
                for name in CLASSES
                if len(of_class := of_kind.loc[of_kind["class"] == name])
            ]
            if not by_class:
                lines.append(f"{paper} {kind}s: {NONE}")
            else:
                edge = list(of_kind["on_edge"]).count(True)
                lines.append(f"{paper} {kind}s: {'; '.join(by_class)}; {edge} on the edge")
                words = of_kind["standing"].map(word)
                standings.append(f"{kind}s {counts(words, (*STANDINGS, NEEDS_NONE, WITHOUT))}")
        lines.append(f"{paper} under other readings: {'; '.join(standings)}")
    unexpected = list(table["as_expected"]).count(False)
    risk = min(1.0, table["seed_risk"].sum())
    return [
        *lines,
        f"all papers: {unexpected} verdicts not as expected; "
        f"a fresh root seed fails `snakemake verify` with probability at most {risk:.2g}",
    ]


def word(standing: str) -> str:
    """A standing without its readings and its reason."""
    if standing.startswith(NEEDS_NONE):
        return NEEDS_NONE
    return standing.partition(" ")[0] or WITHOUT


def counts(found: Iterable[str], kinds: Iterable[str]) -> str:
    """How many are of each kind that there is."""
    of_kind = Counter(found)
    return ", ".join(f"{of_kind[kind]} {kind}" for kind in kinds if kind in of_kind)


EDGE = " (on the edge)"  # another root seed may give another verdict


class Section(NamedTuple):
    """A table of the pages: the values, or the claims, of a paper."""

    title: str
    head: tuple[str, ...]
    rows: list[list[str]]


def sections(table: pd.DataFrame, joint: pd.DataFrame) -> Iterator[Section]:
    """The tables of all papers; in each, what does not reproduce comes first.

    `joint` has the printed tables as a whole, see `compare_tables`.
    """
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
            wholes = joint.loc[joint["paper"] == paper].to_dict("records")
            if kind == "value" and wholes:
                yield Section(f"{paper}: each table as a whole", JOINT_HEAD, [*map(_whole, wholes)])


def _whole(row: Mapping[Any, Any]) -> list[str]:
    of_test = [f"{row['chi_square']:.1f}", f"{row['p_value']:.2g}"]
    sizes = [str(row["cells"]), str(row["trials"])]
    return [row["table"], *sizes, *of_test, row["farthest"], f"{row['z']:+.1f}"]


def _verdict(row: Mapping[Any, Any]) -> str:
    return row["verdict"] + EDGE * bool(row["on_edge"])


def _cells(row: Mapping[Any, Any]) -> list[str]:
    if row["kind"] == "claim":
        return [row["item"], row["statement"], row["evidence"]]
    errors = f"{row['mcse']:.2g}, {row['their_error']:.2g}"
    z = "" if np.isnan(row["z"]) else f"{row['z']:+.1f}"
    allowed = "" if np.isnan(row["allowed_percent"]) else f"{row['allowed_percent']:.3g} %"
    return [row["item"], f"{row['published']:g}", f"{row['ours']:.4g}", errors, z, allowed]


def markdown_page(table: pd.DataFrame, joint: pd.DataFrame) -> str:
    """The page results/diff.md."""
    text = [f"# {TITLE}", "", *(f"- {line}" for line in tally_lines(table)), ""]
    for section in sections(table, joint):
        text += [
            f"## {markdown_line(section.title)}",
            "",
            markdown_table(section.head, section.rows),
            "",
        ]
    return "\n".join(text)


def report_page(table: pd.DataFrame) -> str:
    """The first page of the report, shorter than a screen: a line a paper, and where all is."""
    lines = []
    for paper, rows in table.groupby("paper", sort=False):
        by_kind = {kind: rows.loc[rows["kind"] == kind, "verdict"] for kind in VERDICTS}
        told = [f"{k}s: {counts(v, VERDICTS[k])}" for k, v in by_kind.items() if len(v)]
        lines.append(f"- {_escaped(f'{paper}, ' + '; '.join(told))}")
    text = [TITLE, "=" * len(TITLE), "", *lines, "", _escaped(WHERE)]
    return "\n".join(text) + "\n"


def _escaped(text: str) -> str:
    """A text in one line, in which nothing means anything to reStructuredText or to Jinja."""
    shown = (f"\\{c}" if c in string.punctuation else c for c in " ".join(text.split()))
    return "".join(shown)
