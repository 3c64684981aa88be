"""The digest of a rule covers exactly the modules that its job imports, no more, no less."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from repro.workflow.code import code_files, constants
from tests.conftest import ROOT, registered

HEAVY = ("pandas", "matplotlib", "scipy.stats", "numba")
# A process for each filter and study, forked from one that has imported what every job does.
IMPORTED = f"""
import json, os, sys
from importlib.util import find_spec
import repro.runner
import repro.workflow.job
from repro import plugins

for line in sys.stdin:
    name, study = line.split()
    if os.fork():
        os.wait()
        continue
    plugins.filter_module(name), plugins.study(study)
    modules = [module for name, module in sys.modules.items() if name.split(".")[0] == "repro"]
    files = [module.__file__ for module in modules]
    if "repro.kernels.compiled" in sys.modules:  # the first call of a kernel imports it, and numba
        files.append(find_spec("repro.kernels.machine_code").origin)
    heavy = [name for name in {HEAVY} if name in sys.modules]
    print(json.dumps([heavy, sorted(files)]), flush=True)
    os._exit(0)
"""


@pytest.fixture(scope="module")
def imported():
    """What a fresh process imports, by filter and study: heavy packages, and files of ours."""
    pairs = [(name, study) for name, study, _ in registered()]
    done = subprocess.run(
        [sys.executable, "-c", IMPORTED],
        input="".join(f"{name} {study}\n" for name, study in pairs),
        capture_output=True,
        text=True,
        check=True,
        env={"PYTHONPATH": str(ROOT / "src")},
    )
    return dict(zip(pairs, map(json.loads, done.stdout.splitlines()), strict=True))


@pytest.mark.parametrize(("name", "study", "point"), registered())
def test_code_agrees_with_what_a_fresh_process_imports(name, study, point, imported):
    heavy, files = imported[name, study]
    named = code_files(
        "repro.workflow.job", "repro.runner", f"repro.filters.{name}", f"repro.studies.{study}"
    )
    assert [str(Path(file).relative_to(ROOT)) for file in files] == named
    assert heavy == []


def test_figures_declare_what_they_read():
    scripts = sorted((ROOT / "figures").glob("*/*.py"))
    assert scripts
    for script in scripts:
        declared = constants(str(script))
        assert isinstance(declared["NEEDS"], dict) and declared["CAPTION"], script
