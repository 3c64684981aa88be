"""The machine code of kernels is kept safely."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from repro.kernels import compiled, machine_code

SOURCE = """
from repro.kernels.compiled import kernel

OFFSET = 1.0

@kernel
def shifted(x):
    return x + OFFSET
"""
CALL = """
import sys
sys.path.insert(0, sys.argv[1])
from own_kernels import shifted
print(shifted(2.0), sum(shifted.dispatcher.stats.cache_hits.values()))
"""


@pytest.fixture
def folder(tmp_path):
    install = tmp_path / "install"
    install.mkdir()
    (install / "own_kernels.py").write_text(SOURCE)
    return install


def start(folder, **environment):
    removed = {"NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "NUMBA_DISABLE_JIT"}
    inherited = {key: value for key, value in os.environ.items() if key not in removed}
    return subprocess.Popen(
        [sys.executable, "-B", "-c", CALL, str(folder)],
        env=inherited
        | {
            "HOME": str(folder.parent / "home"),
            "PYTHONPATH": str(Path(compiled.__file__).parents[2]),
        }
        | environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def called(folder, **environment):
    """What a new process gets from the kernel, and how often its cache had it."""
    return result(start(folder, **environment))


def result(process):
    out, err = process.communicate(timeout=100)
    assert process.returncode == 0, err
    assert not err
    value, hits = out.split()
    return float(value), int(hits)


def entries(folder):
    return sorted(folder.rglob(f"*{machine_code.SUFFIX}"))


def test_kept_rebuilt_and_renewed(folder):
    assert called(folder) == (3.0, 0)
    (entry,) = entries(folder)
    assert called(folder) == (3.0, 1)
    for corrupt in (b"", entry.read_bytes()[:-100], b"x" * 5000):
        entry.write_bytes(corrupt)
        assert called(folder) == (3.0, 0)
        assert called(folder) == (3.0, 1)
    (folder / "own_kernels.py").write_text(SOURCE.replace("OFFSET = 1.0", "OFFSET = 7.0"))
    assert called(folder) == (9.0, 0)
    (renewed,) = entries(folder)
    assert renewed != entry


def test_another_kind_of_cpu_has_its_own_entry(folder):
    assert called(folder) == (3.0, 0)
    other = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
    assert called(folder, **other) == (3.0, 0)
    assert called(folder, **other) == (3.0, 1)
    assert called(folder) == (3.0, 1)
    assert len(entries(folder)) == 2


def test_read_only_install_uses_the_users_cache(folder):
    (folder / "__pycache__").write_text("not a folder: nothing can be kept here")
    assert called(folder) == (3.0, 0)
    assert len(entries(folder.parent / "home" / ".cache")) == 1
    assert called(folder) == (3.0, 1)
    nowhere = {"HOME": "/dev/null"}
    assert called(folder, **nowhere) == (3.0, 0)
    assert called(folder, **nowhere) == (3.0, 0)
    named = folder.parent / "named"
    assert called(folder, NUMBA_CACHE_DIR=str(named)) == (3.0, 0)
    assert len(entries(named)) == 1


def test_two_processes_at_once(folder):
    both = [start(folder), start(folder)]
    assert sorted(map(result, both)) == [(3.0, 0), (3.0, 1)]  # the second waits for the first
    assert len(entries(folder)) == 1
    assert called(folder) == (3.0, 1)
    assert {path.suffix for path in (folder / "__pycache__").iterdir()} == {machine_code.SUFFIX}


def test_a_closure_is_refused():
    offset = 1.0
    with pytest.raises(TypeError, match="closure"):
        compiled.kernel(lambda x: x + offset)
