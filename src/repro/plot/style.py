"""The look of the figures, and the names and colours of the filters in them."""

from collections.abc import Collection, Iterable, Sequence
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

matplotlib.use("Agg")

from matplotlib import pyplot, ticker
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from repro import plugins
from repro.atomic import atomic_write
from repro.plot import looks
from repro.tables.results import Results

COLOURS = looks.PALETTE
DECADES = 5  # of an error's axis above what the best filter has
BAND: float = 2.0  # standard errors on either side of a curve
WIDTH = 7.7  # inches of a picture: pages show it 850 pixels wide, its letters 110 to the inch
DIFFERING = "#F9D5BF"  # cell of a table where ours differs from what is printed
PUBLISHED = dict(color="black", marker="_", linestyle="none", markersize=14, markeredgewidth=1.6)

pyplot.rcParams.update(
    {
        "figure.dpi": 200,
        "figure.constrained_layout.use": True,
        "font.size": 9.5,
        "axes.grid": True,
        "grid.alpha": 0.3,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
    }
)


def figure(
    rows: int = 1, columns: int = 1, size: tuple[float, float] = (7.0, 4.3), **axes: Any
) -> tuple[Figure, Any]:
    """A figure and its axes: one, or an array of them; further arguments are those of subplots."""
    return pyplot.subplots(rows, columns, figsize=size, **axes)


def table(
    rows: Sequence[Iterable[Any]],
    heads: tuple[str, ...],
    widths: tuple[float, ...],
    differing: Collection[tuple[int, int]] = (),
) -> Figure:
    """A table as a picture; widths are shares of the figure's, `differing` cells are coloured."""
    drawn, axes = figure(size=(WIDTH, 0.29 * (len(rows) + 1) + 0.2))
    axes.axis("off")
    cells = axes.table(rows, colLabels=heads, colWidths=widths, cellLoc="left", bbox=(0, 0, 1, 1))
    cells.auto_set_font_size(False)
    cells.set_fontsize(9)
    for (row, _), cell in cells.get_celld().items():
        cell.set(linewidth=0.4, edgecolor="0.7")
        if row == 0:
            cell.set(facecolor="0.92")
    for row, column in differing:
        cells[row + 1, column].set(facecolor=DIFFERING)
    return drawn


def label(filter_: str) -> str:
    """The name of a filter in tables and figures."""
    return plugins.filter_module(filter_).LABEL


def look(results: Results, filter_: str) -> dict[str, Any]:
    """Colour and marker of a filter, the same in every figure."""
    return looks.look(filter_, results.own_filters)


def bounds(value: Any, mcse: Any, log: bool) -> tuple[np.ndarray, np.ndarray]:
    """Two standard errors below and above; of the logarithm, which stays positive, if `log`.

    An error is taken to be known to a factor of e^2 at least, where one run makes up the mean.
    """
    value, mcse = np.asarray(value, dtype=float), np.asarray(mcse, dtype=float)
    if not log:
        return value - BAND * mcse, value + BAND * mcse
    relative = np.divide(mcse, value, out=np.zeros_like(value), where=value > 0)
    factor = np.exp(BAND * np.clip(relative, 0.0, 1.0))
    return value / factor, value * factor


def band(axes: Axes, x: Any, value: Any, mcse: Any, colour: Any, log: bool = True) -> None:
    """The `bounds` of a curve as an area."""
    axes.fill_between(x, *bounds(value, mcse, log), color=colour, alpha=0.18, lw=0)


def bars(value: Any, mcse: Any, log: bool = True) -> np.ndarray:
    """Lengths of the two halves of an error bar that ends at the `bounds`, (2, ...)."""
    low, high = bounds(value, mcse, log)
    return np.stack([value - low, high - value])


def interlaced(place: int, number: int) -> dict[str, Any]:
    """Line style of one of several curves that lie on each other: the first below, solid and wide.

    The dashes of the others take turns on it, so that every colour is seen.
    """
    if place == 0:
        return {"lw": 3.0, "ls": "-"}
    return {"lw": 1.5, "ls": (4.0 * (place - 1), (4.0, 4.0 * max(number - 2, 1)))}


def plain_log(axes: Axes, which: str = "y") -> None:
    """A logarithmic axis of less than three decades, with plain numbers at 1, 2 and 5."""
    axes.set(**{f"{which}scale": "log"})
    axis = getattr(axes, f"{which}axis")
    axis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    axis.set_minor_formatter(ticker.NullFormatter())


def error_axis(axes: Axes, which: str) -> None:
    """Scale and limits for the errors that are drawn: logarithmic from a factor of 4 on.

    Errors of 0 are left out. Those of filters that diverge leave the axes `DECADES` above the
    largest error of the best filter.
    """
    curves = [getattr(line, f"get_{which}data")() for line in axes.lines]
    shown = [c[np.isfinite(c) & (c > 0)] for c in (np.asarray(c, dtype=float) for c in curves)]
    shown = [curve for curve in shown if len(curve)]
    if not shown:
        return
    low, high = min(map(np.min, shown)), max(map(np.max, shown))
    highest = min(map(np.max, shown)) * 10.0**DECADES
    _scale(axes, low, min(high, highest), which)
    if high > highest:
        axes.set(**{f"{which}lim": (low / 2, highest)})


def number_axis(axes: Axes, values: Sequence[float], which: str) -> None:
    """Scale for a swept number: logarithmic if it spans a decade and more, in its middle too."""
    low, high = min(values), max(values)
    if low > 0 and high / low > 20 and np.median(values) < (low + high) / 4:
        _scale(axes, low, high, which)
    elif all(float(value).is_integer() for value in values):
        axis = getattr(axes, f"{which}axis")
        axis.set_major_locator(ticker.MaxNLocator(integer=True))


def _scale(axes: Axes, low: float, high: float, which: str) -> None:
    if high < 4 * low:
        return
    if high < (1e3 if which == "y" else 60) * low:  # numbers need more room side by side
        plain_log(axes, which)
    else:
        axes.set(**{f"{which}scale": "log"})
        axis = getattr(axes, f"{which}axis")
        axis.set_major_locator(ticker.LogLocator(numticks=7))
        axis.set_minor_formatter(ticker.NullFormatter())


def save(drawn: Figure, path: str | Path) -> None:
    """Write a PNG whose bytes depend on the drawing alone, of 256 colours: a third of the size."""
    # Not savefig, which draws a figure with a layout engine twice.
    canvas = FigureCanvasAgg(drawn)
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[..., :3]
    with atomic_write(path) as part:
        Image.fromarray(pixels).quantize(256, dither=Image.Dither.NONE).save(part, format="PNG")
    pyplot.close(drawn)
