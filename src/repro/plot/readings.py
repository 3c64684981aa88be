"""What the choices that a paper leaves open change: a statistic of the filters at each reading."""

import re
from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from repro.parameters.point_names import is_reading, reading_of
from repro.plot import style
from repro.plot.style import BAND
from repro.plot.sweep import running
from repro.tables.results import Results

NEXT_NAME = re.compile(r"-(?=[a-z_]+=)")  # between two changed parameters of a point's name
SPREAD = 0.76  # of the filters at a reading; readings are 1 apart
ROW = 0.36  # inches of a reading
EXPLAINED = f"bars ±{BAND:g} standard errors, crosses median runs"


def in_words(reading: str) -> str:
    """The name of a reading, or of a point, without prefix and underscores."""
    changed = NEXT_NAME.sub(", ", reading.removeprefix("reading-"))
    words = changed.replace("_", " ").replace("@", "; ").replace("=", " = ")
    return " ".join(words.split())


def readings_of_point(results: Results, study: str, base: str) -> list[str]:
    """The point, and the points that read it otherwise."""
    other = [p for p in results.catalogue[study] if is_reading(p) and reading_of(p)[1] == base]
    return [base, *other]


def draw_readings(
    axes: Axes,
    results: Results,
    study: str,
    base: str,
    metric: str,
    component: str,
    filters: Iterable[str],
    title: str,
    log: bool = True,
) -> None:
    """A row a reading, around whose tick the filters, and a reader's own, are spread."""
    table = results.table(study)
    table = table.loc[(table["metric"] == metric) & (table["component"] == component)]
    points = readings_of_point(results, study, base)
    drawn_on = running(results, study, dict(enumerate(points)), filters)
    for i, (filter_, on) in enumerate(drawn_on.items()):
        rows = table.loc[table["filter"] == filter_].set_index("point").loc[list(on.values())]
        look: dict[str, Any] = style.look(results, filter_) | {"linestyle": "none"}
        at = np.array(list(on)) + SPREAD * ((i + 0.5) / len(drawn_on) - 0.5)
        length = style.bars(rows["value"], rows["mcse"], log)
        axes.errorbar(
            rows["value"], at, xerr=length, ms=4, lw=1, label=style.label(filter_), **look
        )
        axes.plot(rows["median"], at, "x", ms=4, color=look["color"], alpha=0.7)
    for place in np.arange(len(points) - 1) + 0.5:
        axes.axhline(place, color="0.9", lw=0.7, zorder=0)
    words = ["as in the paper's figures", *(in_words(reading_of(p)[0]) for p in points[1:])]
    axes.set_yticks(np.arange(len(points)), words, fontsize=8)
    axes.set_ylim(len(points) - 0.5, -0.5)
    axes.grid(False, axis="y")
    trials = sorted(set(table.loc[table["point"].isin(points), "trials"]))
    runs = f"{trials[0]} to {trials[-1]}" if len(trials) > 1 else f"{trials[0]}"
    axes.set_title(f"{title}, {runs} runs; {EXPLAINED}", fontsize=9)
    if log:
        axes.set_xscale("log")
