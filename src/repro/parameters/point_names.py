"""What the name of a point says of it."""

import re

# Points whose names begin so take minutes: they run only where they are asked for.
ON_REQUEST = "sensitivity-"
READING = re.compile(r"(^|-)reading-")
OF = "@"  # <reading>@<point>: the point under that reading


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


def batch_of(point: str) -> str:
    """The points of a study of one batch are simulated, and filtered, in one job."""
    if on_request(point):
        return "requested"
    return "readings" if is_reading(point) else "main"
