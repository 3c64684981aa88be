"""What verdicts are called, and where their figures are."""

import re
from collections.abc import Collection, Mapping
from typing import Any

from repro.pages.site.fragments import number, slug

ROMAN = {"I": 1, "II": 2, "III": 3, "IV": 4, "V": 5}


def in_words(name: str) -> str:
    """The name of a paper as a title."""
    return name.replace("_", " ").capitalize()


def anchor(row: Mapping[str, Any]) -> str:
    """Anchor of a verdict on the page of its paper."""
    return slug(row["item"])


def where_and_what(row: Mapping[str, Any]) -> tuple[str, str]:
    """Figure, table or section of a row, and what is said there, in words."""
    text = row["statement"] or row["item"]
    where, colon, what = text.partition(": ")
    if not colon:
        return "", text
    if row["kind"] == "value":
        return where, f"{what}: {number(row['published'], 5)}"
    return where, what[0].upper() + what[1:].rstrip(".")


def margin(row: Mapping[str, Any]) -> str:
    """How far our number is from its limit: standard errors in favour, or off the print."""
    if row["margin"] != row["margin"]:
        return "exact"
    if row["kind"] == "value":
        return f"{number(row['margin'], 2)} off the print"
    side = "in favour" if row["margin"] <= 0 else "against"
    far = number(abs(row["margin"]), 2)
    return f"exact, {side}" if far == "∞" else f"{far} {side}"


def pictures_named(where: str, drawn: Collection[str]) -> list[str]:
    """Figures and tables that a text names, of those that are drawn.

    `Figs. 2-4, 9-11` are fig02 to fig04 and fig09 to fig11; `Figs. 5a, b` are fig05a and fig05b.
    """
    found: list[str] = []
    for match in re.finditer(r"(Fig|Table)s?\.? ([0-9IVX][0-9IVXa-c, -]*)", where):
        kind = match[1].lower()
        last = 0
        for part in filter(None, re.split(r", *", match[2].strip(" ,-"))):
            ends = [_parsed(end, last) for end in part.split("-") if end.strip()]
            if not ends or None in ends:
                continue
            first, letter = ends[0]  # type: ignore[misc]
            last = ends[-1][0]  # type: ignore[index]
            found += [f"{kind}{n:02d}{letter}" for n in range(first, last + 1)]
    return [name for name in dict.fromkeys(found) if name in drawn]


def _parsed(text: str, last: int) -> tuple[int, str] | None:
    """Number and letter of a figure; a letter alone is of the last number."""
    match = re.fullmatch(r"(\d+|[IVX]+)?([a-c])?", text.strip())
    if match is None:
        return None
    written = match[1]
    if written is None:
        return (last, match[2]) if match[2] else None
    value = int(written) if written.isdigit() else ROMAN.get(written)
    return None if value is None else (value, match[2] or "")
