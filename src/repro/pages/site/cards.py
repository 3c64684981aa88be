"""A card for each claim: statement, figure, verdict, evidence, readings and reason."""

from collections.abc import Sequence
from html import escape

from repro.pages.site.content import Content, Row
from repro.pages.site.fragments import (
    badge,
    details,
    link,
    number,
    raw,
    standing_badge,
    table,
    tag,
)
from repro.pages.site.words import anchor, margin, pictures_named, where_and_what

EDGE = "On the edge: another root seed may give another verdict."


def card(content: Content, row: Row) -> str:
    """The card of a claim, as a block of its paper's page."""
    where, what = where_and_what(row)
    words = badge(row["verdict"]) + badge(row["class"]) + standing_badge(row["standing"])
    head = tag("p", words + tag("span", escape(where), class_="where"), class_="words")
    text = head + tag("h4", escape(what)) + "".join(_facts(row))
    text += _comparisons(content.comparisons, row) + _readings(content.robustness, row)
    body = tag("div", text, class_="card-text") + _pictures(content, row["paper"], where)
    look = f"claim-card verdict-{row['verdict']}"
    return raw(tag("section", body, class_=look, id=anchor(row)))


def _facts(row: Row) -> list[str]:
    named = {
        "Evidence": row["evidence"],
        "Margin": f"{margin(row)} (standard errors, least favourable comparison)",
        "Readings": row["standing"] or "no reading of the paper concerns it",
        "Reason": row["reason"] or (EDGE if row["on_edge"] is True else ""),
    }
    pairs = [tag("dt", name) + tag("dd", escape(text)) for name, text in named.items() if text]
    return [tag("dl", "".join(pairs))]


def _comparisons(comparisons: Sequence[Row], row: Row) -> str:
    mine = [c for c in comparisons if (c["paper"], c["item"]) == (row["paper"], row["item"])]
    cells = [
        [
            escape(str(c["part"])),
            f"{number(c['difference'])} ± {number(c['mcse'], 2)}",
            number(c["margin"], 2),
            badge(c["verdict"]),
        ]
        for c in mine
    ]
    head = (
        "comparison (the claim says: below zero)",
        "difference",
        "in standard errors",
        "verdict",
    )
    return details(f"All {len(mine)} comparisons", table(head, cells)) if mine else ""


def _readings(robustness: Sequence[Row], row: Row) -> str:
    mine = [r for r in robustness if (r["paper"], r["item"]) == (row["paper"], row["item"])]
    cells = [
        [
            escape(str(r["reading"]).removeprefix("reading-")),
            escape(r["changes"]),
            number(r["margin"], 2),
            number(r["trials"]),
            badge(r["verdict"]),
        ]
        for r in mine
    ]
    head = ("reading", "what it changes", "margin", "trials", "verdict")
    return details(f"Verdict under {len(mine)} other readings", table(head, cells)) if mine else ""


def _pictures(content: Content, paper: str, where: str) -> str:
    """The first figure that the statement names, and links to all of them."""
    names = pictures_named(where, content.drawn(paper))
    if not names:
        return ""
    first = names[0]
    source = f"../thumbnails/{paper}/{first}.png"
    picture = f'<img src="{source}" alt="{escape(first)} redrawn" loading="lazy">'
    shown = tag("a", picture, href=f"../gallery/{paper}/{first}.html")
    links = " ".join(link(name, f"../gallery/{paper}/{name}.html") for name in names)
    return tag("div", shown + tag("p", f"Redrawn: {links}"), class_="card-picture")
