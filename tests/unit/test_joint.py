"""The test of a printed table as a whole, on simulated tables of which the truth is known."""

import numpy as np
import pandas as pd
import pytest

from repro.errors import ReproError
from repro.verdicts import joint
from repro.verdicts.joint import Cells, compare_tables, joint_test

CELLS, TRIALS, THEIRS = 4, 40, 20
TRUTH = np.array([1.0, 2.0, 3.0, 4.0])
# The trials are common to the cells: their errors go together.
MIXED = np.linalg.cholesky(0.02 * np.eye(CELLS) + 0.98)


def left_out(rng):
    """Means of simulated trials with one left out each."""
    trials = TRUTH + rng.standard_normal((TRIALS, CELLS)) @ MIXED.T
    return (trials.sum(axis=0) - trials) / (TRIALS - 1)


def printed(rng, digits):
    means = TRUTH + rng.standard_normal((THEIRS, CELLS)).mean(axis=0) @ MIXED.T
    return np.round(means, digits)


@pytest.mark.parametrize("digits", [1, 6])
def test_a_true_table_is_rejected_as_often_as_stated(digits):
    rng, given = np.random.default_rng(3), (np.full(CELLS, digits), np.full(CELLS, THEIRS))
    p = [joint_test(left_out(rng), printed(rng, digits), *given).p_value for _ in range(2000)]
    shares = [np.mean(np.array(p) < level) for level in (0.05, 0.5)]
    assert shares == pytest.approx([0.05, 0.5], abs=0.045)
    assert shares[0] == pytest.approx(0.05, abs=0.02)


def test_cells_that_go_together_are_not_allowed_to_go_apart():
    """Each cell alone is within two errors; no common error moves one up and the next down."""
    rng = np.random.default_rng(4)
    ours, given = left_out(rng), (np.full(CELLS, 6), np.full(CELLS, THEIRS))
    error = 1 / np.sqrt(THEIRS)
    together = joint_test(ours, ours.mean(axis=0) + error, *given)
    apart = joint_test(ours, ours.mean(axis=0) + error * np.array([1, -1, 1, -1]), *given)
    assert np.abs(apart.z).max() < 2
    assert together.p_value > 0.2 and apart.p_value < 1e-6


def test_the_file_has_a_row_a_table_and_unknown_cells_are_refused(tmp_path, monkeypatch):
    rng = np.random.default_rng(5)
    items = [f"T: {i}" for i in range(CELLS)]
    tables = {"T": lambda results: Cells(items, left_out(rng))}
    values = pd.DataFrame({"item": items, "value": [1.0, 2.0, 3.0, 9.0], "digits": 2})
    monkeypatch.setattr(joint, "find_spec", lambda name: True)
    monkeypatch.setattr(joint, "import_module", lambda name: type("", (), {"TABLES": tables}))
    monkeypatch.setattr(joint, "read_published", lambda path: values.assign(trials=THEIRS))
    compare_tables(None, "paper", "file", tmp_path / "joint.csv")
    (row,) = pd.read_csv(tmp_path / "joint.csv").to_dict("records")
    assert (row["table"], row["cells"], row["trials"]) == ("T", CELLS, TRIALS)
    assert row["farthest"] == "T: 3" and row["p_value"] < 1e-6
    items[0] = "T: 7"
    with pytest.raises(ReproError, match="file: T: there is no value 'T: 7'"):
        compare_tables(None, "paper", "file", tmp_path / "joint.csv")
    few = joint_test(left_out(rng)[:4], TRUTH, np.full(CELLS, 2), np.full(CELLS, THEIRS))
    assert np.isnan(few.p_value)
