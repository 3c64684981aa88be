"""A small version of every study, as digests: logs, estimates and statistics of a few trials.

They are the same bytes on every machine; those that are committed let anyone see whether a machine
agrees: `python -m tests.reference`. After a change that is meant to move numbers, `--write`.
"""

import hashlib
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from repro import plugins
from repro.parameters.load import load_paper
from repro.parameters.point_names import is_common, reading_of
from repro.runner import run
from repro.statistics.shards import Shards
from tests.conftest import ROOT, catalogue, points, settings, small_log

COMMITTED = Path(__file__).parent / "digests.txt"
TRIALS, STEPS = 3, 40


def digests(study: str) -> list[str]:
    """A line for the log and for each filter of the first point of each family."""
    lines = []
    for point, filters in _first_of_families(study).items():
        log = small_log(study, point, TRIALS, STEPS)
        lines.append(f"{study} {point} log {_digest(log.values)}")
        for name in filters:
            estimate, runs = run(log, name, settings(study, point, name))
            arrays = {"estimate": estimate, "error": runs.error} | runs.recorded
            if runs.claimed is not None:
                arrays["claimed"] = runs.claimed
            arrays |= _statistics(study, Shards([lambda runs=runs: runs], [TRIALS]))
            lines.append(f"{study} {point} {name} {_digest(arrays)}")
    return lines


def _first_of_families(study: str) -> dict[str, list[str]]:
    """The filters of the first point of each family; of a reading those that it gives settings."""
    families: dict[str, str] = {}
    for point, filters in catalogue()[study].items():
        if filters and is_common(point):
            family, _ = reading_of(points()[study][point].family)
            families.setdefault(family, point)
    return {point: _filters(study, point) for point in families.values()}


def _filters(study: str, point: str) -> list[str]:
    every, (_, read) = catalogue()[study][point], reading_of(point)
    if not read:
        return every
    both = [f for f in every if f in catalogue()[study][read]]
    changed = [f for f in both if settings(study, point, f) != settings(study, read, f)]
    return changed or every[:1]  # of a parameter: the log is what differs


def _statistics(study: str, shards: Shards) -> dict[str, Any]:
    """What a study's table and curves have."""
    scenario = plugins.study(study)
    analysis = scenario.Analysis.checked(_analyses()[study], study)
    rows = [*scenario.rows(shards, analysis), *scenario.curves(shards)]
    return {f"{metric} {of}": np.array(row, dtype=float) for metric, of, row in rows}


@cache
def _analyses() -> dict[str, Any]:
    """What params/ has of the analysis of each study."""
    papers = map(load_paper, (ROOT / "params").glob("[!r]*.yaml"))
    return {study: given for paper in papers for study, given in paper.analysis.items()}


def _digest(arrays: dict[str, np.ndarray]) -> str:
    total = hashlib.sha256()
    for name, values in sorted(arrays.items()):
        numbers = np.ascontiguousarray(values)
        numbers = np.where(np.isnan(numbers), np.nan, numbers)  # a NaN has many bit patterns
        total.update(name.encode() + numbers.tobytes())
    return total.hexdigest()[:16]
