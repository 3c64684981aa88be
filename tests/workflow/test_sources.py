"""The digest of a rule covers exactly the modules that its job imports, no more, no less."""

import subprocess
import sys
from pathlib import Path

import pytest

from repro.workflow.code import code_files, constants
from tests.conftest import ROOT, registered

HEAVY = ("pandas", "matplotlib", "scipy.stats", "numba")


@pytest.mark.parametrize(("name", "study", "point"), registered())
def test_code_agrees_with_what_a_fresh_process_imports(name, study, point):
    script = f"""
import sys
import repro.runner
import repro.workflow.job
from repro import plugins
plugins.filter_module("{name}"), plugins.study("{study}")
print([name for name in {HEAVY} if name in sys.modules])
if "repro.kernels.compiled" in sys.modules:
    import repro.kernels.machine_code  # as the first call of a kernel does
modules = [module for name, module in sys.modules.items() if name.split(".")[0] == "repro"]
print("\\n".join(sorted(module.__file__ for module in modules)))
"""
    done = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True,
        text=True,
        check=True,
        env={"PYTHONPATH": str(ROOT / "src")},
    )
    heavy, *imported = done.stdout.split("\n")[:-1]
    named = code_files(
        "repro.workflow.job", "repro.runner", f"repro.filters.{name}", f"repro.studies.{study}"
    )
    assert [str(Path(file).relative_to(ROOT)) for file in imported] == named
    assert heavy == "[]"


def test_figures_declare_what_they_read():
    scripts = sorted((ROOT / "figures").glob("*/*.py"))
    assert scripts
    for script in scripts:
        declared = constants(str(script))
        assert isinstance(declared["NEEDS"], dict) and declared["CAPTION"], script
