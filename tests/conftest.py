"""What several tests share: the parameters, the registered filters, small logs in memory."""

import json
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from repro.logs import Log
from repro.parameters.load import Point, load_paper
from repro.simulate import simulated
from repro.workflow.registry import Catalogue

ROOT = Path(__file__).parent.parent
SEED = 1
LONGEST = ("tests/workflow/", "tests/torture/", "tests/papers/")  # they start Snakemake, or draw


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The folders with the longest files first, so that all workers end together."""
    items.sort(key=lambda item: not item.nodeid.startswith(LONGEST))


@cache
def points() -> dict[str, dict[str, Point]]:
    """Resolved points of every study of every paper."""
    files = sorted(f for f in (ROOT / "params").glob("*.yaml") if f.name != "run.yaml")
    return {study: found for file in files for study, found in load_paper(file).studies.items()}


@cache
def _registration() -> dict[str, Any]:
    """What results/catalogue.json has: the filters of every point and their settings."""
    with tempfile.TemporaryDirectory() as folder:
        written = f"{folder}/results/catalogue.json"
        subprocess.run(
            [sys.executable, "-m", "snakemake", written, "--nolock", "--config", f"into={folder}"],
            cwd=ROOT,
            capture_output=True,
            check=True,
        )
        return json.loads(Path(written).read_text())


def catalogue() -> Catalogue:
    """The filters of every point, as the rules register them."""
    return _registration()["filters"]


def settings(study: str, point: str, filter_: str) -> dict[str, Any]:
    """Settings of a filter at a point, as its rule gives them, else from params/."""
    return _registration()["settings"][study][point][filter_]


def registered() -> list[tuple[str, str, str]]:
    """(filter, study, first point it runs on) of every filter in every study."""
    first = {}
    for study, of_points in catalogue().items():
        for point, filters in of_points.items():
            for name in filters:
                first.setdefault((name, study), point)
    return [(name, study, point) for (name, study), point in first.items()]


@cache
def small_log(study: str, point: str, trials: int = 5, steps: int = 12, first: int = 0) -> Log:
    """A short log of a point, in memory."""
    parameters = points()[study][point].parameters
    parameters = parameters.model_copy(update={"steps": min(parameters.steps, steps)})
    return simulated(study, point, parameters, SEED, np.arange(first, first + trials))
