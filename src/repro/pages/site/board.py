"""The leaderboard as a table that a reader sorts and filters."""

from html import escape

from repro.pages.leaderboard import LEGEND, summarised, with_cpu
from repro.pages.site.content import Content
from repro.pages.site.fragments import link, number, raw, table

HEAD = (
    *("study", "points", "filter", "whose", "error", "median run", "of informed", "of no data"),
    *("better", "worse", "lost", "CPU µs a step"),
)


def leaderboard(content: Content) -> str:
    """The page leaderboard.md."""
    board = with_cpu(summarised(content.leaderboard), content.times)
    cells = [
        [
            link(row["study"], f"studies/{row['study']}.html"),
            escape(row["family"]),
            link(content.label(row["filter"]), f"filters/{row['filter']}.html"),
            escape(row["whose"]),
            *(number(row[name]) for name in HEAD[4:]),
        ]
        for row in board.to_dict("records")
    ]
    shown = table(HEAD, cells, class_="sortable", data_menus="0,2,3", id="leaderboard")
    return "\n".join(["# Leaderboard\n", LEGEND, "", raw(shown)])
