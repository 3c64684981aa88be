"""Logs, estimates and table rows of [unknown_losses] are the same bytes on every machine."""

import hashlib
import os
import subprocess
import sys

import numpy as np
import pytest
from llvmlite.binding import get_host_cpu_features

from repro import plugins
from repro.parameters.load import load_paper
from repro.runner import run
from repro.simulate import simulated
from repro.statistics.shards import Shards
from tests.unit.test_kernel_bits import ENVIRONMENTS

FILTERS = {
    "ekf": {},
    "iekf": {},
    "bkf_1": {},
    "bkf_2": {},
    "exact": {},
    "rbpf": {"particles": 30, "proposal": "optimal", "resampling": "systematic"},
    "rbpf_fast": {"particles": 30, "threshold": 1.0},
    "prior": {},
}
POINTS = ("linear_losses", "loss=0.5"), ("radar", "markov-p=0.1-q=0.3"), ("radar", "loss=0.5")
POINTS += (("radar", "reading-bearing=arctan"),)
WANTED = "4ee039c2be750d5881eae0c77017f992"


def digests() -> dict[str, str]:
    """SHA-256 of what each filter of each point gives, and of the logs."""
    found = {}
    studies = load_paper("params/unknown_losses.yaml").studies
    for study, point in POINTS:
        parameters = studies[study][point].parameters.model_copy(update={"steps": 9})
        log = simulated(study, point, parameters, 1, np.arange(8))
        values = [log.values[topic] for topic in sorted(log.values)]
        found[f"{study} {point}"] = digest(values)
        for name, settings in FILTERS.items():
            estimate, runs = run(log, name, settings)
            rows = plugins.study(study).rows(Shards([lambda r=runs: r], [8]), None)
            numbers = [np.array(statistic) for _, _, statistic in rows]
            found[f"{study} {point} {name}"] = digest([estimate, *numbers])
    return found


def digest(arrays: list[np.ndarray]) -> str:
    total = hashlib.sha256()
    for array in arrays:
        total.update(np.ascontiguousarray(array, dtype=float).tobytes())
    return total.hexdigest()


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_same_bytes(name):
    if name == "haswell" and not get_host_cpu_features().get("avx2"):
        pytest.skip("this CPU cannot run such code")
    command = "from tests.unit.test_loss_filters_bits import digests; print(*digests().items())"
    finished = subprocess.run(
        [sys.executable, "-c", command],
        env=os.environ | ENVIRONMENTS[name] | {"PYTHONPATH": os.pathsep.join(["src", "."])},
        capture_output=True,
        text=True,
        check=True,
    )
    assert hashlib.sha256(finished.stdout.encode()).hexdigest()[:32] == WANTED
