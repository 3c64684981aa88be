"""What a paper leaves open: assumed values, and which verdicts other readings change."""

from collections.abc import Iterator
from html import escape

from repro.pages.site.content import Content, Row
from repro.pages.site.fragments import badge, details, link, raw, table, tag
from repro.pages.site.words import anchor
from repro.verdicts.standing import NOT_RUN, OPPOSITE, too_few_trials

LONGEST = 60  # characters of a value; longer ones are cut


def assumptions(content: Content, paper: str) -> Iterator[str]:
    """The values that a paper does not state, and what each other reading changes."""
    rows = [r for r in content.parameters if r["paper"] == paper and r["source"] == "assumed"]
    stated = [r for r in rows if r["point"] in ("every", "analysis")]
    yield f"The paper does not state {len(stated)} of the values that its studies need.\n"
    cells = [
        [
            escape(r["study"]),
            tag("code", escape(r["parameter"])),
            _cut(r["value"]),
            escape(r["why"]),
        ]
        for r in stated
    ]
    yield raw(
        details(
            f"All {len(stated)} assumed values, with the reasons",
            table(("study", "parameter", "value", "why"), cells, class_="sortable"),
        )
    )
    readings = [r for r in content.robustness if r["paper"] == paper]
    if readings:
        yield "Other readings, and the verdicts that each changes:\n"
        yield raw(_changed(content, paper, readings))


def _changed(content: Content, paper: str, readings: list[Row]) -> str:
    base = {row["item"]: row for row in content.diff if row["paper"] == paper}
    named: dict[str, list[Row]] = {}
    for row in readings:
        named.setdefault(row["reading"], []).append(row)
    cells = []
    for name, rows in named.items():
        judged = [r for r in rows if r["verdict"] != NOT_RUN and r["item"] in base]
        changed = [r for r in judged if _changes(base[r["item"]]["verdict"], r)]
        links = " ".join(_link(base[r["item"]], r) for r in changed)
        cells.append(
            [
                escape(name.removeprefix("reading-")),
                escape(_shortened(rows[0]["changes"])),
                str(len(judged)),
                (str(len(changed)), {"data_order": str(len(changed))}),
                details(f"{len(changed)} changed", links) if changed else "",
            ]
        )
    head = ("reading", "what it changes", "judged", "changed", "which")
    return table(head, cells, class_="sortable")


def _changes(verdict: str, row: Row) -> bool:
    few = too_few_trials(verdict, row["verdict"], row["margin"])
    return row["verdict"] != verdict and not few


def _link(base: Row, row: Row) -> str:
    opposite = OPPOSITE.get(base["verdict"]) == row["verdict"]
    text = link(base["item"], f"#{anchor(base)}") + badge(row["verdict"])
    return tag("span", text, class_="changed opposite" if opposite else "changed")


def _cut(value: str) -> str:
    return tag("code", escape(_shortened(value)))


def _shortened(value: str) -> str:
    return value if len(value) < LONGEST else f"{value[: LONGEST - 3]}..."
