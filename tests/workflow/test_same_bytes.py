"""The same bytes with other libraries and on another kind of CPU."""

import os
import subprocess
import sys

import pytest

from tests.conftest import ROOT, points
from tests.reference import COMMITTED, digests

# Imitations of another machine: by OpenBLAS, by NumPy, by the C library, by numba.
ENVIRONMENTS = {
    "without AVX": {
        "OPENBLAS_CORETYPE": "Nehalem",
        "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4",
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-AVX512F",
    },
    "without AVX-512, kernels for any x86": {
        "OPENBLAS_CORETYPE": "Haswell",
        "NPY_DISABLE_CPU_FEATURES": "X86_V4",
        "NUMBA_CPU_NAME": "generic",
        "NUMBA_CPU_FEATURES": "",
    },
}


def test_the_bytes_of_this_machine_are_those_that_are_committed():
    lines = [line for study in points() for line in digests(study)]
    assert sorted(lines) == sorted(COMMITTED.read_text().splitlines())


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_the_bytes_of_another_machine_are_those_that_are_committed(name):
    path = os.pathsep.join([str(ROOT / "src"), str(ROOT)])
    run = subprocess.run(
        [sys.executable, "-W", "ignore", "-m", "tests.reference"],
        cwd=ROOT,
        env=os.environ | ENVIRONMENTS[name] | {"PYTHONPATH": path},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stdout + run.stderr
