"""Verdicts at a glance: every published value and every claim of a paper, and the tally of all."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.plot import style
from repro.tables.results import Results
from repro.verdicts.published import VERDICTS

COLOURS = {
    "match": "#009E73",
    "holds": "#009E73",
    "undecided": "#E69F00",
    "differs": "#D55E00",
    "fails": "#D55E00",
}
LARGEST = 12.0  # standard errors drawn; what is farther is drawn at the edge


def verdicts(results: Results, paper: str) -> Figure:
    """Left: ours over published with both error bars. Right: the comparisons of each claim."""
    diff = results.diff()
    diff = diff.loc[diff["paper"] == paper]
    values, claims = diff.loc[diff["kind"] == "value"], diff.loc[diff["kind"] == "claim"]
    exact = (values["their_error"] == 0) & (values["verdict"] == "match")
    shown = values.loc[~exact]
    rows = max(len(shown), len(claims), 4)
    shares = {"width_ratios": [1, 1.3] if len(shown) > 4 else [1, 2]}
    size = (12.5, 1.4 + 0.24 * rows)
    if len(shown):
        drawn, (left, right) = style.figure(1, 2, size=size, gridspec_kw=shares)
        _draw_values(left, shown, list(exact).count(True))
    else:
        drawn, right = style.figure(size=size)
    _draw_claims(right, claims, results.claims(paper), results.tolerance)
    return drawn


def _draw_values(axes: Axes, values: pd.DataFrame, exact: int) -> None:
    place = np.arange(len(values))
    published = values["published"].to_numpy()
    colours = [COLOURS[verdict] for verdict in values["verdict"]]
    theirs = values["their_error"].to_numpy() / published
    axes.barh(place, 2 * theirs, left=1 - theirs, height=0.7, color="0.85", lw=0)
    ratio, error = values["ours"].to_numpy() / published, values["mcse"].to_numpy() / published
    axes.hlines(place, ratio - error, ratio + error, colors=colours)
    axes.scatter(ratio, place, color=colours, s=18, zorder=3)
    axes.axvline(1, color="black", lw=1)
    also = f"; {exact} exact ones match" if exact else ""
    axes.set(
        yticks=place,
        yticklabels=values["item"],
        xlabel="ours / published (grey: their error)",
        title=f"Published values{also}",
        ylim=(max(len(values), 4) - 0.5, -0.5),
    )


def _draw_claims(axes: Axes, claims: pd.DataFrame, parts: pd.DataFrame, tolerance: float) -> None:
    names = list(claims["item"])
    for place, (item, verdict) in enumerate(zip(names, claims["verdict"], strict=True)):
        part = parts.loc[parts["item"] == item]
        with np.errstate(divide="ignore", invalid="ignore"):
            z = part["difference"].to_numpy() / part["mcse"].to_numpy()
        z = np.nan_to_num(np.clip(-z, -LARGEST, LARGEST))
        axes.plot(z, np.full(len(z), place), "|", color=COLOURS[verdict], ms=11, mew=1.6)
    axes.axvspan(-tolerance, tolerance, color="0.9", lw=0, zorder=0)
    axes.axvline(0, color="black", lw=1)
    axes.set(
        yticks=np.arange(len(names)),
        yticklabels=[f"{n}: {v}" for n, v in zip(names, claims["verdict"], strict=True)],
        xlim=(-LARGEST - 0.5, LARGEST + 0.5),
        xlabel=f"in favour, in standard errors (grey: within {tolerance:g})",
        title="Claims, every comparison",
    )
    axes.invert_yaxis()


def tally(results: Results) -> Figure:
    """How many published values and claims of each paper reproduce."""
    diff = results.diff()
    papers = list(dict.fromkeys(diff["paper"]))
    drawn, grid = style.figure(1, 2, size=(9.0, 1.3 + 0.5 * len(papers)), sharey=True)
    for axes, (kind, kinds) in zip(grid, VERDICTS.items(), strict=True):
        rows = diff.loc[diff["kind"] == kind]
        left = np.zeros(len(papers))
        for verdict in kinds:
            of_verdict = list(rows.loc[rows["verdict"] == verdict, "paper"])
            counts = np.array([of_verdict.count(paper) for paper in papers])
            hatch = "//" if verdict == "undecided" else None
            axes.barh(papers, counts, left=left, color=COLOURS[verdict], hatch=hatch, label=verdict)
            for row, (count, start) in enumerate(zip(counts, left, strict=True)):
                if count:
                    axes.annotate(f"{count:g}", (start + count / 2, row), ha="center", va="center")
            left += counts
        axes.set(title=f"published {kind}s")
        axes.legend(fontsize=8, ncols=3, loc="upper center", bbox_to_anchor=(0.5, -0.15))
        axes.grid(False)
    grid[0].invert_yaxis()
    return drawn
