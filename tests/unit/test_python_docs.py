"""The page on the Python interface and the notebook run as they are printed, on few trials."""

import json
import re

import matplotlib
import pytest

from tests.conftest import ROOT

PAGE, NOTEBOOK = ROOT / "docs/python.md", ROOT / "docs/notebook.ipynb"
BLOCK = re.compile(r"^```python\n(.*?)^```", re.M | re.S)
matplotlib.use("Agg")


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """Every test works in another folder than the project's."""
    monkeypatch.chdir(tmp_path)


def executed(sources):
    """The variables that the sources leave, run in order as the cells of a notebook."""
    names = {"__name__": "__main__"}
    for number, source in enumerate(sources, start=1):
        exec(compile(source, f"block {number}", "exec"), names)
    return names


def fewer(source, trials):
    """The source with fewer trials; it must set their number."""
    changed, count = re.subn(r"\btrials ?= ?\d+", f"trials={trials}", source)
    assert count == 1
    return changed


def test_the_page_runs(capsys):
    blocks = BLOCK.findall(PAGE.read_text())
    names = executed([fewer(blocks[0], 5), *blocks[1:]])
    assert names["found"].estimate.shape == (5, 41, 6)
    assert set(names["table"].index) == {"losses known", "RBPF", "mine"}
    assert names["estimate"].shape == (6, 2)
    assert isinstance(names["cause"], Exception)
    assert "filter Broken on radar, loss=0.5: step(state, k, seen) at step 1" in (
        capsys.readouterr().out
    )


def test_the_notebook_runs_and_stores_no_output():
    cells = json.loads(NOTEBOOK.read_text())["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert not any(cell["outputs"] or cell["execution_count"] for cell in code)
    first, *others = ("".join(cell["source"]) for cell in code)
    names = executed([fewer(first, 8), *others])
    table = names["table"]
    assert set(table.index) == {"losses known", "RBPF", "mine", "no data"}
    assert len(names["axes"].lines) == 3
