"""What results come from, so that a stale one is not taken for a new one.

Snakemake reruns what has changed, by its records of the last run. These can be lost, or belong to
another clone; and a job that outlives its run can put its result over a later one. So logs and runs
carry where they come from, and whoever reads them compares it with what the rules expect.
"""

import hashlib
import json
from typing import Any

from repro.errors import ReproError


def digest(*parts: Any) -> str:
    """Of values as JSON has them: parameters, settings, seeds, digests of code."""
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:16]


def of_shard(trials: int, shard: int, shards: int) -> tuple[int, int]:
    """First and last + 1 of the trials of a shard."""
    return shard * trials // shards, (shard + 1) * trials // shards


def origin(made_with: str, trials: tuple[int, int]) -> str:
    """As a log or run carries it: the digest of what it was made with, and its trials."""
    first, end = trials
    return f"{made_with}, trials {first} to {end - 1}"


def check_origin(path: str, found: str, expected: str) -> None:
    """Raise ReproError unless a result comes from where the rules expect it to come from."""
    if found == expected:
        return
    of_found, of_expected = (text.partition(", ")[2] for text in (found, expected))
    if not of_found:
        what = "it does not say what it was made with"
    elif of_found != of_expected:
        what = f"it has {of_found}, and {of_expected} are asked for"
    else:
        what = "it was made with other parameters, seed or code than now"
    raise ReproError(
        f"{path}: stale: {what}, and Snakemake has no record of it; remove the file and run again"
    )
