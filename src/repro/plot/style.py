"""The look of the figures, and the names and colours of the filters in them."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot, ticker
from matplotlib.figure import Figure

from repro import plugins
from repro.atomic import atomic_write
from repro.tables.results import Catalogue

# Okabe and Ito's palette: told apart with any kind of colour vision.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999933")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
PUBLISHED = dict(color="black", marker="_", linestyle="none", markersize=14, markeredgewidth=1.6)

pyplot.rcParams.update(
    {
        "figure.dpi": 110,
        "figure.constrained_layout.use": True,
        "font.size": 9.5,
        "axes.grid": True,
        "grid.alpha": 0.3,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
    }
)


def figure(rows: int = 1, columns: int = 1, size: tuple[float, float] = (7.0, 4.3), **axes):
    """A figure and its axes."""
    return pyplot.subplots(rows, columns, figsize=size, **axes)


def table(rows, heads: tuple[str, ...], widths: tuple[float, ...]) -> Figure:
    """A table as a picture; widths are shares of the figure's."""
    drawn, axes = figure(size=(7.6, 0.29 * (len(rows) + 1) + 0.2))
    axes.axis("off")
    cells = axes.table(rows, colLabels=heads, colWidths=widths, cellLoc="left", bbox=(0, 0, 1, 1))
    cells.auto_set_font_size(False)
    cells.set_fontsize(9)
    for (row, _), cell in cells.get_celld().items():
        cell.set(linewidth=0.4, edgecolor="0.7")
        if row == 0:
            cell.set(facecolor="0.92")
    return drawn


def label(filter_: str) -> str:
    """The name of a filter in tables and figures."""
    return plugins.filter_module(filter_).LABEL


def look(catalogue: Catalogue, study: str, filter_: str) -> dict:
    """Colour and marker of a filter, by its place in the catalogue: a new filter changes none."""
    order = list(dict.fromkeys(f for filters in catalogue[study].values() for f in filters))
    place = order.index(filter_)
    return {"color": COLOURS[place % len(COLOURS)], "marker": MARKERS[place % len(MARKERS)]}


def plain_log(axes, which: str = "y") -> None:
    """A logarithmic axis of less than three decades, with plain numbers at 1, 2 and 5."""
    axes.set(**{f"{which}scale": "log"})
    axis = getattr(axes, f"{which}axis")
    axis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    axis.set_minor_formatter(ticker.NullFormatter())


def save(drawn: Figure, path: str | Path) -> None:
    """Write a PNG whose bytes depend on the drawing alone."""
    with atomic_write(path) as part:
        drawn.savefig(part, metadata={"Software": None})
    pyplot.close(drawn)
