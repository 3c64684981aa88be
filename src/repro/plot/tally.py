"""How many published values and claims reproduce, by paper and by what the evidence is worth."""

import re

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from repro.plot import style
from repro.plot.verdicts import COLOURS, WIDTH
from repro.tables.results import Results
from repro.verdicts.published import CLASSES, VERDICTS

INITIALS = re.compile(r"\b[A-Z]\.(?:[- ]?[A-Z]\.)* *")
ROW = 0.2  # inches


def tally(results: Results) -> Figure:
    """A row for each class of evidence of the values, and of the claims, of a paper."""
    diff, authors = results.diff(), results.authors()
    lines: list[tuple[str, dict[str, int] | None]] = []  # a text, and counts by verdict if any
    for paper, of_paper in diff.groupby("paper", sort=False):
        lines.append((INITIALS.sub("", authors.get(str(paper), str(paper))), None))
        for kind, verdicts in VERDICTS.items():
            of_kind = of_paper.loc[of_paper["kind"] == kind]
            if of_kind.empty:
                lines.append((f"{kind}s: none printed", {}))
            for name in CLASSES:
                found = list(of_kind.loc[of_kind["class"] == name, "verdict"])
                if found:
                    lines.append((f"{kind}s, {name}", {v: found.count(v) for v in verdicts}))
    drawn, axes = style.figure(size=(WIDTH, ROW * len(lines) + 0.7))
    for place, (_, counts) in enumerate(lines):
        left = 0
        for verdict, count in (counts or {}).items():
            if count:
                hatch = "///" if verdict == "undecided" else None
                axes.barh(
                    place, count, left=left, color=COLOURS[verdict], hatch=hatch, edgecolor="white"
                )
                axes.annotate(
                    f"{count} {verdict}" if count > 3 else f"{count}",
                    (left + count / 2, place),
                    ha="center",
                    va="center",
                    fontsize=7,
                    color="black" if verdict == "undecided" else "white",
                )
                left += count
    axes.set_yticks(np.arange(len(lines)), [text for text, _ in lines], fontsize=8)
    for label, (_, counts) in zip(axes.get_yticklabels(), lines, strict=True):
        label.set_fontweight("bold" if counts is None else "normal")
    axes.tick_params(axis="y", length=0)
    axes.set(ylim=(len(lines) - 0.4, -0.6), xlabel="number of values, or of claims")
    drawn.legend(
        handles=[
            Patch(color=COLOURS["match"], label="match, holds"),
            Patch(
                facecolor=COLOURS["undecided"], hatch="///", edgecolor="white", label="undecided"
            ),
            Patch(color=COLOURS["differs"], label="differs, fails"),
        ],
        fontsize=8,
        ncols=3,
        loc="outside lower center",
    )
    axes.grid(False, axis="y")
    return drawn
