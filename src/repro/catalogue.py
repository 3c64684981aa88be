"""Which points of a study a filter runs on, by the patterns that its rule gives."""

from collections.abc import Iterable
from fnmatch import fnmatchcase


def matching_points(
    points: Iterable[str], wanted: str | list[str] = "*", skipped: str | list[str] = ()
) -> list[str]:
    """Points that match a pattern of `wanted` and none of `skipped` (shell patterns)."""
    wanted = [wanted] if isinstance(wanted, str) else wanted
    skipped = [skipped] if isinstance(skipped, str) else skipped
    return [
        point
        for point in points
        if any(fnmatchcase(point, pattern) for pattern in wanted)
        and not any(fnmatchcase(point, pattern) for pattern in skipped)
    ]
