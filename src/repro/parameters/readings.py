"""Which points are readings of which, and what they change."""

from collections.abc import Mapping
from typing import Any

from repro.parameters.point_names import is_plain, is_reading, reading_of

NOT_ASSUMED = {"trials"}  # differs between points without being an assumption about the paper

# `parameters` and settings by filter (`filters`) of each point of a study, as JSON has them.
Points = Mapping[str, Mapping[str, Any]]


def readings_of(points: Points) -> dict[str, dict[str, Any]]:
    """The readings of a study: the `points` that each is of, and the values that it `changes`.

    A reading named <reading>@<point> is of that point; any other is of the point that it differs
    from in the fewest values.
    """
    found: dict[str, dict[str, Any]] = {}
    for point in filter(is_reading, points):
        reading, read = reading_of(point)
        base, changes = base_of(
            point, {read: points[read], point: points[point]} if read else points
        )
        of_reading = found.setdefault(reading, {"points": {}, "changes": changes})
        of_reading["points"][base] = point
    return found


def base_of(point: str, points: Points) -> tuple[str, dict[str, Any]]:
    """The point that a reading is a reading of, and the values that the reading changes.

    The base is the point that its name says, else the one, itself no reading, that differs in the
    fewest values.
    """
    values = _flat(points[point])
    _, read = reading_of(point)
    changes = {}
    for other, content in points.items():
        if other == read or (not read and is_plain(other)):
            base_values = _flat(content)
            changes[other] = {k: v for k, v in values.items() if base_values.get(k) != v}
    base = min(changes, key=lambda other: len(changes[other]))
    return base, changes[base]


def _flat(point: Mapping[str, Any]) -> dict[str, Any]:
    """Parameters, and settings as filter.setting, of a point."""
    settings = {
        f"{filter_}.{name}": value
        for filter_, values in point["filters"].items()
        for name, value in values.items()
    }
    return {k: v for k, v in point["parameters"].items() if k not in NOT_ASSUMED} | settings
