"""Logs that no job names as its input, looked at in Snakemake's place.

A job writes the logs of a batch, and those who read them name the first of these alone, for
Snakemake takes time and memory for each file that a job names. So it would not see that one of the
others is missing, or has changed since a filter read it.
"""

import os
from collections.abc import Sequence
from functools import cache


def unseen_changes(logs: Sequence[str], named: Sequence[str], runs: str) -> list[str]:
    """Files to make again: logs that are missing, and runs that are older than one of their logs.

    Where one of the `named` logs is itself missing or newer than the runs, Snakemake sees it.
    """
    seen = [_modified(log) for log in named]
    if not all(seen):
        return []
    missing = [log for log in logs if not _modified(log)]
    changed = max(seen) <= _modified(runs) < max(map(_modified, logs))
    return [*missing, runs] if changed else missing


@cache
def _modified(file: str) -> int:
    """When a file was modified, ns, as it was at the start; 0 if there was none."""
    try:
        return os.stat(file).st_mtime_ns  # noqa: PTH116 - a Path takes twice as long
    except OSError:
        return 0
