"""All four papers in one picture: what reproduces, on what evidence, and how firmly."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from repro.plot import style
from repro.plot.counts import OF_VERDICTS, Bar, counted, draw_bars, patches, without_initials
from repro.plot.style import WIDTH
from repro.tables.results import Results
from repro.verdicts.published import CLASSES, REPRODUCED, VERDICTS
from repro.verdicts.standing import STANDINGS

ROW = 0.34  # inches
# From what could not fail to what could.
OF_CLASSES: dict[str, str] = dict(
    zip(CLASSES, ("#DADAEB", "#BCBDDC", "#54278F", "#9E9AC8"), strict=True)
)
NO_READING = "no other reading"
OF_STANDINGS: dict[str, str] = dict(
    zip(
        (*STANDINGS, NO_READING),
        ("#08519C", "#DEEBF7", "#6BAED6", "#F2C46D", "#E3E3E3"),
        strict=True,
    )
)


def scoreboard(results: Results) -> Figure:
    """A row a paper: values and claims by verdict, by class of evidence, and by standing."""
    diff, authors = results.diff(), results.authors()
    of_papers = dict(iter(diff.groupby("paper", sort=False)))
    names = {p: _name(str(p), authors.get(str(p), "")) for p in of_papers}
    drawn, grid = style.figure(2, 2, size=(WIDTH, 2 * (ROW * len(names) + 0.85) + 0.2), sharey=True)
    for axes, (kind, verdicts) in zip(grid[0], VERDICTS.items(), strict=True):
        of_kind = diff.loc[diff["kind"] == kind]
        bars = []
        for paper, name in names.items():
            found = of_kind.loc[of_kind["paper"] == paper, "verdict"]
            bars.append(Bar(name, counted(found, verdicts)))
        draw_bars(axes, bars, OF_VERDICTS, size=9)
        for place, bar in enumerate(bars):
            if not sum((bar.counts or {}).values()):
                axes.annotate("none printed", (0.5, place), va="center", fontsize=9)
        good = of_kind["verdict"].isin(REPRODUCED).sum()
        what = "published values match" if kind == "value" else "claims hold"
        axes.set_title(f"{good} of {len(of_kind)} {what}", fontsize=10.5, fontweight="bold")
    by_class = [Bar(n, counted(of_papers[p]["class"], CLASSES)) for p, n in names.items()]
    draw_bars(grid[1, 0], by_class, OF_CLASSES, size=9)
    tests = diff["class"].isin(("predicted", "conditional")).sum()
    grid[1, 0].set_title(f"{tests} rest on tests that could fail", fontsize=10.5, fontweight="bold")
    standings = {p: _standings(of_paper) for p, of_paper in of_papers.items()}
    by_standing = [Bar(n, counted(standings[p], OF_STANDINGS)) for p, n in names.items()]
    draw_bars(grid[1, 1], by_standing, OF_STANDINGS, size=9)
    robust = sum(found.count(STANDINGS[0]) for found in standings.values())
    concerned = sum(len(found) - found.count(NO_READING) for found in standings.values())
    grid[1, 1].set_title(
        f"{robust} of {concerned} keep their verdict\nunder every other reading",
        fontsize=10.5,
        fontweight="bold",
    )
    every = {name for found in standings.values() for name in found}
    seen = {name: name for name in OF_STANDINGS if name in every}
    for axes, handles in (
        (grid[0, 0], patches(OF_VERDICTS, {"match": "match", "differs": "differs"})),
        (grid[0, 1], patches(OF_VERDICTS, {name: name for name in VERDICTS["claim"]})),
        (grid[1, 0], patches(OF_CLASSES, {name: name for name in CLASSES})),
        (grid[1, 1], patches(OF_STANDINGS, seen)),
    ):
        axes.legend(
            handles=handles,
            fontsize=8,
            ncols=len(handles),
            loc="upper center",
            bbox_to_anchor=(0.5, -0.16),
            columnspacing=0.8,
            handlelength=0.9,
            handletextpad=0.4,
            borderpad=0.0,
        )
    return drawn


def _name(paper: str, authors: str) -> str:
    """Subject, and first author with the year where it is given."""
    first, _, rest = without_initials(authors).partition(",")
    year = rest[rest.index("(") :] if "(" in rest else ""
    return f"{paper.replace('_', ' ')}\n{first} et al. {year}"


def _standings(of_paper: pd.DataFrame) -> list[str]:
    return [
        text.split(" ")[0] if isinstance(text, str) and text else NO_READING
        for text in of_paper["standing"].replace({np.nan: ""})
    ]
