"""Pieces of HTML that pages share. Texts of others are escaped here, and here only."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape

MEANINGS = {
    "identity": "an exact equality or count",
    "fitted": "a parameter was chosen on these numbers: agreement shows that such a one exists",
    "predicted": "a test that could have failed",
    "conditional": "a test that could have failed, but rests on an assumed layout or horizon",
    "robust": "the verdict is the same under every reading of what the paper leaves open",
    "open": "no reading has enough trials to decide",
    "reversed": "a reading of what the paper leaves open gives the opposite verdict",
    "without reading": "no reading of the paper concerns this verdict",
}
READINGS = re.compile(r" under | on | \(|: ")  # between the word of a standing and its readings
CONDITIONAL_ON = "a reading of what the paper leaves open gives another verdict"


def raw(html: str) -> str:
    """HTML as a block of a MyST page."""
    fence = "`" * 3
    return f"{fence}{{raw}} html\n{html}\n{fence}\n"


def tag(name: str, content: str, **attributes: str | None) -> str:
    """An element; `content` is HTML already; an attribute that is None is left out."""
    given = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{escape(value)}"'
        for key, value in attributes.items()
        if value is not None
    )
    return f"<{name}{given}>{content}</{name}>"


def link(text: str, target: str, class_: str | None = None) -> str:
    """A link; the text is escaped."""
    return tag("a", escape(text), href=target, class_=class_)


def badge(word: str, title: str | None = None) -> str:
    """A verdict, class of evidence or standing as a coloured word."""
    return tag(
        "span",
        escape(word),
        class_=f"badge-{slug(word)} word-badge",
        title=title or MEANINGS.get(word),
    )


def standing_badge(standing: str) -> str:
    """The first word of a standing; the readings that it names in its title."""
    word = READINGS.split(standing)[0] or "without reading"
    meaning = CONDITIONAL_ON if word == "conditional" else MEANINGS.get(word, "")
    return badge(word, title=f"{meaning}. {standing}" if standing else meaning)


def slug(text: str) -> str:
    """A text as an anchor or a class: small letters, digits and hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")


def number(value: object, digits: int = 3) -> str:
    """A number with so many significant digits; empty where it is not known."""
    if not isinstance(value, int | float):
        return str(value)
    if math.isnan(value):
        return ""
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    shown = f"{value:.{digits}g}" if abs(value) < 10**digits else f"{value:.0f}"
    return shown.replace("-", "−") if "e" not in shown else shown


def table(
    head: Sequence[str],
    rows: Iterable[Sequence[str | tuple[str, Mapping[str, str]]]],
    class_: str = "plain",
    **attributes: str | None,
) -> str:
    """A table in a box that scrolls by itself. A cell is HTML, or that and attributes."""
    heads = "".join(tag("th", escape(name), scope="col") for name in head)
    body = "".join(tag("tr", "".join(map(_cell, row))) for row in rows)
    inner = tag("thead", tag("tr", heads)) + tag("tbody", body)
    return tag("div", tag("table", inner, class_=class_, **attributes), class_="wide")


def _cell(cell: str | tuple[str, Mapping[str, str]]) -> str:
    return tag("td", cell) if isinstance(cell, str) else tag("td", cell[0], **cell[1])


def details(summary: str, content: str) -> str:
    """A part that opens on a click; the summary is escaped, the content HTML."""
    return tag("details", tag("summary", escape(summary)) + content)
