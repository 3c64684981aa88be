"""Figure 1: block diagram of the networked system."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

from repro.plot import style
from repro.tables.results import Results

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = (
    "Figure 1. The plant, N sensors with saturation, battery and harvester, channels, filter; "
    "the number of sensors and the largest energy are those of the base point in the plane."
)


def box(
    axes: Axes,
    x: float,
    y: float,
    text: str,
    colour: str,
    width: float = 1.7,
    height: float = 0.62,
) -> None:
    """A rounded box with its text, centred on (x, y)."""
    axes.add_patch(
        FancyBboxPatch(
            (x - width / 2, y - height / 2),
            width,
            height,
            boxstyle="round,pad=0.04",
            fc=colour,
            ec="black",
            lw=0.9,
        )
    )
    axes.text(x, y, text, ha="center", va="center", fontsize=8.5)


def arrow(
    axes: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    text: str = "",
    above: float = 0.12,
) -> None:
    """An arrow with a text above its middle."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": "black", "lw": 1})
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2 + above)
    axes.text(*middle, text, ha="center", va="bottom", fontsize=8.5)


def draw(results: Results) -> Figure:
    parameters = results.parameters("rss_2d", "base")
    capacity = parameters.energy_capacity
    drawn, axes = style.figure(size=(9.4, 4.0))
    axes.set(xlim=(-0.15, 13.6), ylim=(-0.1, 4.85))
    axes.axis("off")
    box(axes, 0.9, 2.0, "plant\n$x_{k+1}=$\n$f_k(x_k)+\\omega_k$", "#DCE9F5", 1.6, 3.45)
    for y, i in ((3.4, "1"), (0.6, "N")):
        box(axes, 3.9, y, f"sensor {i}\n$h^{i}(x_k)$", "#DCE9F5")
        box(axes, 6.4, y, "saturation\nif $\\gamma_k=1$", "#FBE3D6")
        box(axes, 9.1, y, "send if\n$E_k>0$", "#FBE3D6")
        box(
            axes,
            9.1,
            y + 0.98,
            f"battery $E_k \\leq {capacity}$, harvest $H_k$",
            "#E2F0E6",
            width=2.7,
            height=0.42,
        )
        arrow(axes, (9.1, y + 0.73), (9.1, y + 0.37))
        arrow(axes, (1.8, y), (3.0, y), "$x_k$", above=0.03)
        arrow(axes, (4.8, y), (5.5, y))
        arrow(axes, (7.3, y), (8.2, y), f"$+\\nu^{i}_k$\n$y^{i}_k$", above=0.03)
        arrow(axes, (10.0, y), (11.5, y), f"$+n^{i}_k$\n$z^{i}_k$", above=0.03)
    axes.text(
        6.4, 2.0, f"$\\vdots$\nN = {parameters.sensors}", fontsize=11, ha="center", va="center"
    )
    box(axes, 12.4, 2.0, "remote filter\n$\\hat{x}_k$ from $z_{1:k}$", "#DCE9F5", 1.7, 3.45)
    return drawn
