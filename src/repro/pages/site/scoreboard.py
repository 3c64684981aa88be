"""The home page: what this is, and a row for every published statement of all papers."""

from collections.abc import Iterable, Iterator
from html import escape

from repro.pages.site.content import Content, Row
from repro.pages.site.fragments import badge, link, raw, standing_badge, table, tag
from repro.pages.site.words import anchor, in_words, margin, where_and_what
from repro.verdicts.published import CLASSES, VERDICTS

HEAD = ("paper", "where", "the paper says", "verdict", "evidence", "margin", "readings", "kind")
FILTERED = ("paper", "verdict", "evidence", "readings", "kind")  # columns with a menu
# Verdict -> colour of its part of a bar, and its word after a number.
PARTS = {
    "match": ("reproduced", "match"),
    "differs": ("not", "differ"),
    "holds": ("reproduced", "hold"),
    "undecided": ("open", "undecided"),
    "fails": ("not", "fail"),
}

INTRODUCTION = """\
Four papers on state estimation when measurements are lost, delayed, censored, or not sent for lack
of energy. Their studies are rebuilt here from their parameters alone, and every published number
and claim is tested against the result.

Does the claim of Fig. 8 hold, how surely, and why not? Find its row, and follow it to its card:
the figure, the evidence, the verdict under every other reading of the text, and the reason.
"""
LEGEND = """\
The **margin** is in standard errors: of the least favourable comparison behind a claim, or of our
number from the printed one. **Evidence** says what a verdict is worth, and **readings** whether it
stays the same under other readings of what the paper leaves open; point at a word for its meaning.
Values that agree to rounding have an exact margin. A star (\\*) marks a verdict on the edge, which
another seed of the random numbers may change.
"""


def home(content: Content) -> str:
    """The page index.md, without its list of contents."""
    parts = ["# Filtering over unreliable networks: four papers, reproduced\n", INTRODUCTION]
    parts += [raw("".join(_summaries(content)))]
    parts += ["## Every published statement\n", LEGEND, raw(scoreboard(content.diff))]
    return "\n".join(parts)


def scoreboard(rows: Iterable[Row]) -> str:
    """The table of all statements, which a reader sorts and filters."""
    columns = ",".join(str(HEAD.index(name)) for name in FILTERED)
    claims_first = sorted(rows, key=lambda row: row["kind"] != "claim")
    cells = [_cells(row) for row in claims_first]
    return table(HEAD, cells, class_="sortable scoreboard", data_menus=columns, id="scoreboard")


def _cells(row: Row) -> list[str | tuple[str, dict[str, str]]]:
    where, what = where_and_what(row)
    target = f"papers/{row['paper']}.html#{anchor(row)}"
    key = -row["margin"] if row["kind"] == "claim" else -abs(row["margin"])
    order = {"data_order": str(1e9 if key != key else max(-1e9, min(1e9, key)))}
    edge = " *" if row["on_edge"] is True else ""
    return [
        escape(in_words(row["paper"])),
        escape(where),
        link(what, target),
        badge(row["verdict"]) + edge,
        badge(row["class"]),
        (escape(margin(row)), order),
        standing_badge(row["standing"]),
        escape(row["kind"]),
    ]


def _summaries(content: Content) -> Iterator[str]:
    """A card for each paper: its title, how its verdicts are divided, a link."""
    cards = []
    for name, paper in content.papers.items():
        rows = [row for row in content.diff if row["paper"] == name]
        bars = "".join(_bar(kind, rows) for kind in VERDICTS)
        heading = link(in_words(name), f"papers/{name}.html", class_="paper-name")
        cards.append(
            tag(
                "div",
                heading + tag("p", escape(f"{paper.authors}: {paper.title}")) + bars,
                class_="paper-card",
            )
        )
    yield tag("div", "".join(cards), class_="paper-cards")
    counted = {name: sum(row["class"] == name for row in content.diff) for name in CLASSES}
    words = ", ".join(f"{count} {badge(name)}" for name, count in counted.items() if count)
    yield tag("p", f"{len(content.diff)} statements: {words}.", class_="counted")


def _bar(kind: str, rows: list[Row]) -> str:
    """How the verdicts of a kind are divided, as a bar with its counts."""
    of_kind = [row for row in rows if row["kind"] == kind]
    if not of_kind:
        return tag("p", f"{kind}s: none printed", class_="bar-label")
    parts, words = "", []
    for verdict, (group, word) in PARTS.items():
        count = sum(row["verdict"] == verdict for row in of_kind)
        if count:
            parts += tag("span", str(count), class_=f"part-{group}", style=f"flex-grow: {count}")
            words.append(f"{count} {word}")
    label = tag("p", escape(f"{len(of_kind)} {kind}s: {', '.join(words)}"), class_="bar-label")
    return label + tag("div", parts, class_="bar", role="img", aria_label="; ".join(words))
