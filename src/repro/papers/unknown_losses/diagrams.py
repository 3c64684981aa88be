"""[unknown_losses Figs. 6, 7]: the quadrotor and its loop, drawn."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, FancyBboxPatch

from repro.plot import style

BODY, EARTH, PLANT = style.COLOURS[0], "0.25", style.COLOURS[2]
Place = Sequence[float] | np.ndarray  # x and y in the drawing
VIEW = np.array([[-0.62, -0.45], [0.93, -0.20], [0.0, 0.90]])  # directions of x, y, z on the paper


def _seen(points: np.ndarray) -> np.ndarray:
    """Points in space (..., 3) as drawn, (..., 2)."""
    return points @ VIEW


def _arrow(axes: Axes, start: Place, end: Place, colour: str, width: float = 1.6) -> None:
    look: dict[str, Any] = {"arrowstyle": "-|>", "mutation_scale": 12, "shrinkA": 0, "shrinkB": 0}
    axes.add_patch(
        FancyArrowPatch(
            (start[0], start[1]), (end[0], end[1]), color=colour, lw=width, zorder=6, **look
        )
    )


def _text(axes: Axes, place: Place, text: str, colour: str = "black", size: float = 9.5) -> None:
    axes.text(
        place[0], place[1], text, color=colour, ha="center", va="center", fontsize=size, zorder=7
    )


def _turn(
    axes: Axes,
    centre: np.ndarray,
    axis: int,
    radius: float,
    degrees: tuple[float, float],
    colour: str,
) -> None:
    """An arrow turning about an axis (0, 1, 2), positive if the angles rise, as seen in space."""
    angles = np.deg2rad(np.linspace(degrees[0], degrees[1], 40))
    circle = np.zeros((40, 3))
    circle[:, (axis + 1) % 3], circle[:, (axis + 2) % 3] = np.cos(angles), np.sin(angles)
    arc = _seen(np.array(centre) + radius * circle)
    axes.plot(*arc.T, color=colour, lw=1.3, zorder=6)
    _arrow(axes, arc[-4], arc[-1], colour, width=1.3)


def _frame(
    axes: Axes, origin: np.ndarray, length: float, names: tuple[str, str, str], colour: str
) -> None:
    for direction, name in zip(np.eye(3), names, strict=True):
        start, end = _seen(origin), _seen(origin + length * direction)
        _arrow(axes, start, end, colour)
        _text(axes, end + 0.2 * (end - start) / np.hypot(*(end - start)), name, colour, 11)


def quadrotor() -> Figure:
    """Fig. 6: axes, states, and the numbers and senses of the rotors."""
    drawn, axes = style.figure(size=(7.6, 4.9))
    axes.axis("off")
    centre, angles = np.zeros(3), np.linspace(0, 2 * np.pi, 80)
    disc = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=-1)
    for number, end in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1)), start=1):
        tip = 1.6 * np.array([*end, 0])
        axes.plot(*_seen(np.stack([centre, tip])).T, color="black", lw=3.5)
        axes.fill(*_seen(tip + 0.6 * disc).T, facecolor="0.9", edgecolor="0.45", lw=1.2, alpha=0.8)
        # The drag of rotors 2 and 4 turns the body to +psi: they themselves turn the other way.
        sense = (70, -60) if number in (2, 4) else (-60, 70)
        _turn(axes, tip, 2, 0.48, sense, style.COLOURS[1])
        lift = _seen(np.stack([tip, np.add(tip, (0, 0, 0.75))]))
        _arrow(axes, lift[0], lift[1], "0.5", width=1.2)
        _text(axes, np.add(lift[1], (0, 0.13)), f"$F_{number}$", "0.35")
        _text(axes, np.add(_seen(tip), (-0.25, 0.12)), rf"$\omega_{number}$", style.COLOURS[1], 11)
    axes.add_patch(Circle((0.0, 0.0), 0.14, facecolor="0.3", edgecolor="black", zorder=5))
    _frame(axes, centre, 3.0, ("x, U", "y, V", "z, W"), BODY)
    turns = ((r"$\phi$, P", (0.3, -0.28)), (r"$\theta$, Q", (0.1, 0.42)), (r"$\psi$, R", (0.55, 0)))
    for axis, (name, beside) in enumerate(turns):
        place = 2.72 * np.eye(3)[axis]
        _turn(axes, place, axis, 0.22, (-140, 130), BODY)
        _text(axes, np.add(_seen(place), beside), name, BODY, 11)
    origin = np.array([0.0, -4.2, -1.5])
    _frame(axes, origin, 0.9, ("X", "Y", "Z"), EARTH)
    axes.plot(*_seen(np.stack([origin, centre])).T, color=EARTH, lw=0.9, ls=":", zorder=1)
    _text(axes, np.add(_seen(origin), (0.25, -0.55)), "inertial frame", EARTH)
    _text(axes, np.add(_seen(origin / 2), (-0.35, 0.22)), "[X, Y, Z]", EARTH)
    weight = _seen(np.stack([centre, centre - [0, 0, 1.0]]))
    _arrow(axes, weight[0], weight[1], "0.5", width=1.2)
    _text(axes, np.add(weight[1], (0.25, 0.0)), "m g", "0.35")
    axes.set(aspect="equal")
    axes.autoscale_view()
    return drawn


def _box(axes: Axes, x: float, y: float, text: str, colour: str = BODY, width: float = 1.5) -> None:
    corner, height = (x - width / 2, y - 0.45), 0.9
    look: dict[str, Any] = {
        "boxstyle": "round,pad=0.02,rounding_size=0.08",
        "facecolor": "white",
        "lw": 1.5,
    }
    axes.add_patch(FancyBboxPatch(corner, width, height, edgecolor=colour, zorder=3, **look))
    _text(axes, (x, y), text, size=8.5)


def _wire(
    axes: Axes,
    points: list[tuple[float, float]],
    text: str = "",
    at: Place = (0, 0),
    colour: str = "black",
) -> None:
    """A line through points that ends in an arrow."""
    corners = np.array(points, dtype=float)
    axes.plot(*corners[:-1].T, color=colour, lw=1.2, zorder=2)
    _arrow(axes, corners[-2], corners[-1], colour, width=1.2)
    _text(axes, at, text, colour, 8.5)


def control_loop() -> Figure:
    """Fig. 7: path, outer and inner PID, mixing, quadrotor, sensors, losses, filter."""
    drawn, axes = style.figure(size=(10.0, 3.9))
    axes.axis("off")
    top, low, half, edge = 2.6, 0.6, 0.77, 0.47
    path, outer, inner, mixing, plant = 0.9, 3.0, 5.3, 7.4, 9.6
    channel, estimator = 6.9, 4.15
    _box(axes, path, top, "path\ncommand", EARTH)
    _box(axes, outer, top, "outer-loop PID\n(position,\nvelocity)")
    _box(axes, inner, top, "inner-loop PID\n(attitude,\naltitude)")
    _box(axes, mixing, top, "throttle\nmixing")
    _box(axes, plant, top, "motors and\nquadrotor", PLANT)
    _box(axes, plant, low, "IMU, GPS", PLANT)
    _box(axes, channel, low, "lossy channel\n$y=\\gamma\\, h(x)+v$", style.COLOURS[1], 1.9)
    _box(axes, estimator, low, "filter\n($\\gamma$ unknown)", style.COLOURS[3])
    above = top + 0.2
    _wire(axes, [(path + half, top), (outer - half, top)], "$X_c, Y_c$", (1.95, above))
    # Commands of altitude and yaw pass the outer loop by.
    over = top + 0.95
    passing = [(path, top + edge), (path, over), (inner, over), (inner, top + edge)]
    _wire(axes, passing, "$Z_c, \\psi_c$", (outer, over + 0.2))
    _wire(axes, [(outer + half, top), (inner - half, top)], "$\\phi_c, \\theta_c$", (4.15, above))
    commands = "$c_\\phi, c_\\theta, c_\\psi, c_z$"
    _wire(axes, [(inner + half, top), (mixing - half, top)], commands, (6.35, top + 0.62))
    _wire(axes, [(mixing + half, top), (plant - half, top)], "throttle", (8.5, above))
    _wire(axes, [(plant, top - edge), (plant, low + edge)], "$x$", (plant + 0.15, 1.6))
    _wire(axes, [(plant - half, low), (channel + 0.97, low)], "one packet", (8.35, low + 0.2))
    _wire(axes, [(channel - 0.97, low), (estimator + half, low)], "$y$", (5.45, low + 0.2))
    back = [(estimator - half, low), (outer, low), (outer, top - edge)]
    _wire(axes, back, "$\\hat x$", (outer - 0.2, 1.3))
    _wire(axes, [(outer, 1.6), (inner, 1.6), (inner, top - edge)])
    axes.plot(outer, 1.6, "o", color="black", ms=4)
    beside, known = plant - 0.4, 1.25
    driven = [
        (beside, top - edge),
        (beside, known),
        (estimator + 0.3, known),
        (estimator + 0.3, low + edge),
    ]
    _wire(axes, driven, "rotor speeds $u$, known", (7.1, known + 0.16), "0.45")
    axes.set(xlim=(0, 10.5), ylim=(-0.1, 4.0))
    return drawn
