"""The generated reference of the parameters."""

from repro.pages.parameter_reference import reference
from tests.conftest import ROOT


def test_the_page_is_what_the_types_say():
    regenerate = "python -m repro.pages.parameter_reference > docs/parameters.md"
    assert (ROOT / "docs/parameters.md").read_text() == reference(), f"run: {regenerate}"


def test_types_bounds_and_descriptions_are_shown():
    rows = reference().split("\n")
    assert "| `trials` | integer, ≥ 1 | number of trials, i.e. Monte Carlo runs |" in rows
    jobs = "jobs that the trials of a point are split into"
    assert f"| `shards` | integer, ≥ 1, ≤ 1000 | {jobs} |" in rows
    assert any(row.startswith("| `sampling_time` | number, > 0 or `k` |") for row in rows)
    assert any(row.startswith("| `alpha_rule` | `sum to one` or `8b`") for row in rows)
