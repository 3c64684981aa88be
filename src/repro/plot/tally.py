"""How many published values and claims reproduce: by paper, and by what the evidence is worth."""

from matplotlib.figure import Figure

from repro.plot import style
from repro.plot.counts import OF_VERDICTS, Bar, counted, draw_bars, patches, without_initials
from repro.plot.style import WIDTH
from repro.tables.results import Results
from repro.verdicts.published import CLASSES, VERDICTS

ROW = 0.21  # inches
ROOM_RIGHT = 0.2  # share of the axis, for the numbers beside the longest bar
WORDS = {"match": "match, holds", "undecided": "undecided", "differs": "differs, fails"}


def tally(results: Results) -> Figure:
    """A row for each class of evidence of the values, and of the claims, of a paper; totals."""
    diff, authors = results.diff(), results.authors()
    bars: list[Bar] = []
    for paper, of_paper in diff.groupby("paper", sort=False):
        bars.append(Bar(without_initials(authors.get(str(paper), str(paper)))))
        for kind, verdicts in VERDICTS.items():
            of_kind = of_paper.loc[of_paper["kind"] == kind]
            if of_kind.empty:
                bars.append(Bar(f"{kind}s: none printed", {}))
            for name in CLASSES:
                found = counted(of_kind.loc[of_kind["class"] == name, "verdict"], verdicts)
                if sum(found.values()):
                    bars.append(Bar(f"{kind}s, {name}", found))
    bars.append(Bar("all papers"))
    for kind, verdicts in VERDICTS.items():
        found = counted(diff.loc[diff["kind"] == kind, "verdict"], verdicts)
        bars.append(Bar(f"{kind}s: {sum(found.values())}", found))
    drawn, axes = style.figure(size=(WIDTH, ROW * len(bars) + 0.7))
    draw_bars(axes, bars, OF_VERDICTS, beside=True)
    axes.margins(x=ROOM_RIGHT)
    axes.set_xlabel("number of values, or of claims")
    drawn.legend(
        handles=patches(OF_VERDICTS, WORDS), fontsize=8, ncols=3, loc="outside lower center"
    )
    return drawn
