"""The printed tables beside ours; cells that differ are marked."""

from collections.abc import Iterator, Mapping
from html import escape

from repro.pages.site.content import Content, Row
from repro.pages.site.fragments import number, raw, table, tag
from repro.pages.site.words import anchor

Cell = tuple[str, Mapping[str, str]]


def printed_tables(content: Content, paper: str) -> Iterator[str]:
    """Headings and tables of every printed table of a paper."""
    values = [r for r in content.diff if r["paper"] == paper and r["kind"] == "value"]
    named: dict[str, list[Row]] = {}
    for row in values:
        named.setdefault(row["item"].partition(": ")[0], []).append(row)
    for name, rows in named.items():
        yield f"### {name}\n"
        yield raw(_grid(rows) or _list(rows))
        yield from (
            _as_a_whole(r) for r in content.joint if (r["paper"], r["table"]) == (paper, name)
        )
        reasons = {r["reason"]: r for r in rows if r["reason"] and r["verdict"] == "differs"}
        yield (
            raw(tag("ul", "".join(tag("li", escape(reason)) for reason in reasons)))
            if reasons
            else ""
        )


def _as_a_whole(row: Row) -> str:
    return (
        f"As a whole: chi-square {number(row['chi_square'])} over {row['cells']} cells, "
        f"p = {number(row['p_value'], 2)}; farthest: {row['farthest']}, "
        f"z = {number(row['z'], 2)}.\n"
    )


def _grid(rows: list[Row]) -> str | None:
    """Rows and columns by the names of the cells; None unless that gives a full table."""
    cells: dict[tuple[str, str], Row] = {}
    for row in rows:
        before, _, last = row["item"].partition(": ")[2].rpartition(" ")
        cells[before, last] = row
    lines, columns = (list(dict.fromkeys(key[i] for key in cells)) for i in (0, 1))
    if min(len(lines), len(columns)) < 2 or len(cells) != len(lines) * len(columns):
        return None
    body = [[escape(line), *(_value(cells[line, column]) for column in columns)] for line in lines]
    return table(["", *columns], body, class_="printed")


def _list(rows: list[Row]) -> str:
    body = [[escape(row["item"].partition(": ")[2]), _value(row)] for row in rows]
    return table(["", "printed, and ours"], body, class_="printed")


def _value(row: Row) -> Cell:
    """Printed above ours; the cell says by its class and in words whether they differ."""
    differs = row["verdict"] == "differs"
    error = "" if not row["mcse"] > 0 else f" ± {number(row['mcse'], 2)}"
    text = tag("span", number(row["published"], 5), class_="printed-value")
    text += tag("span", f"{number(row['ours'], 4)}{error}", class_="our-value")
    if row["z"] == row["z"]:
        text += tag("span", f"z = {number(row['z'], 2)}", class_="z-value")
    if differs:
        text += tag("strong", "differs")
    return text, {"class_": "differs" if differs else "match", "id": anchor(row)}
