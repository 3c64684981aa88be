"""Run a figure script on the results."""

import importlib.util
from pathlib import Path

from repro.plot import style
from repro.tables.results import Results


def draw(script: str | Path, results: Results, path: str | Path) -> None:
    """Load the figure script and save what its draw(results) returns."""
    spec = importlib.util.spec_from_file_location(Path(script).stem, script)
    assert spec is not None and spec.loader is not None  # as for every .py file
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    style.save(module.draw(results), path)
