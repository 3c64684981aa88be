"""Logs, estimates and statistics have the same bytes with other libraries and another CPU.

The kernels' own code for other CPUs is tested in test_kernel_bits.
"""

import hashlib
import os
import subprocess
import sys

import numpy as np

from repro import plugins
from repro.runner import run
from repro.statistics.shards import Shards
from tests.conftest import points, small_log

RUNS = {
    ("linear_delays", "reading-sine_period=300"): (
        *("omvf", "nahi", "sun", "genie", "best_in_form", "intermittent_kf", "prior"),
    ),
    ("wsn_tracking", "reading-true_initial_state=drawn"): ("emvf", "emvf_realised", "prior"),
    ("wsn_tracking", "reading-initial_second_moment=matched"): ("emvf",),
    ("quadrotor", "nominal"): ("true_state",),
}
# Neither FMA nor AVX in NumPy, OpenBLAS and the C library.
OTHER = {
    "OPENBLAS_CORETYPE": "Nehalem",
    "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F",
}


def digests() -> str:
    """One line for each log and each filter."""
    lines = []
    for (study, point), filters in RUNS.items():
        log, of_study = small_log(study, point, trials=3, steps=40), plugins.study(study)
        lines.append(f"{study} {point} log {digest(log.values)}")
        for name in filters:
            settings = points()[study][point].filters.get(name, {})
            estimate, runs = run(log, name, settings)
            statistics = of_study.curves(Shards([lambda runs=runs: runs], [3]))
            numbers = {f"{row[:2]}": np.array(row[2], dtype=float) for row in statistics}
            arrays = {"estimate": estimate, "error": runs.error} | runs.recorded | numbers
            lines.append(f"{study} {point} {name} {digest(arrays)}")
    return "\n".join(lines)


def digest(arrays: dict[str, np.ndarray]) -> str:
    total = hashlib.sha256()
    for name, values in sorted(arrays.items()):
        total.update(name.encode() + np.ascontiguousarray(values).tobytes())
    return total.hexdigest()[:16]


def test_same_bytes():
    other = subprocess.run(
        [sys.executable, "-c", "from tests.unit.test_study_bits import digests; print(digests())"],
        env=os.environ | OTHER | {"PYTHONPATH": os.pathsep.join(["src", "."])},
        capture_output=True,
        text=True,
        check=True,
    )
    assert other.stdout.split("\n")[:-1] == digests().split("\n")
