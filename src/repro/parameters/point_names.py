"""What the name of a point says of it."""

import re

# Points whose names begin so take minutes: they run only where they are asked for.
ON_REQUEST = "sensitivity-"
READING = re.compile(r"(^|-)reading-")
OF = "@"  # <reading>@<point>: the point under that reading
# What points are for whose names begin so: a table of its own, and no other table, claim or figure.
OWN_TABLES = ("convergence", "mismatch")


def is_reading(point: str) -> bool:
    """Whether the point is another reading of the paper."""
    return on_request(point) or READING.search(point) is not None


def reading_of(point: str) -> tuple[str, str]:
    """The reading, and the point that is read so; nothing for it if the name does not say it."""
    reading, _, read = point.partition(OF)
    return reading, read


def on_request(point: str) -> bool:
    """Whether the point is left out of the ordinary run."""
    return point.startswith(ON_REQUEST)


def own_table(point: str) -> str:
    """`convergence` or `mismatch` if the point is for that table alone; else nothing."""
    first, _, _ = point.partition("-")
    return first if first in OWN_TABLES else ""


def is_common(point: str) -> bool:
    """Whether the tables, claims and figures of a study have the point."""
    return not (on_request(point) or own_table(point))


def is_plain(point: str) -> bool:
    """Whether the point is the paper's own: no reading, and of no table of its own."""
    return not (is_reading(point) or own_table(point))


def batch_of(point: str) -> str:
    """The points of a study of one batch are simulated, and filtered, in one job."""
    if on_request(point):
        return "requested"
    return own_table(point) or ("readings" if is_reading(point) else "main")
