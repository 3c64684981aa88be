"""Paths of the results."""

import pytest

from repro.layout import Layout

LAYOUT = Layout("somewhere/results")


@pytest.mark.parametrize(
    ("path", "template", "filled"),
    [
        (LAYOUT.log, "logs/{study}/{point}/{shard}.mcap", "logs/a/b/0.mcap"),
        (LAYOUT.run, "runs/{study}/{batch}/{filter}/{shard}.npz", "runs/a/b/f/0.npz"),
        (LAYOUT.view, "views/{study}/{point}/trial-{trial}", "views/a/b/trial-0"),
    ],
)
def test_a_part_that_is_not_given_is_a_wildcard(path, template, filled):
    assert path() == f"somewhere/results/{template}"
    parts = ("a", "b", "f", 0) if "{filter}" in template else ("a", "b", 0)
    assert path(*parts) == f"somewhere/results/{filled}"


def test_tables_claims_and_pages():
    assert LAYOUT.table("radar") == "somewhere/results/tables/radar.csv"
    assert LAYOUT.curves("radar") == "somewhere/results/curves/radar.csv"
    assert LAYOUT.claims("packet_delays") == "somewhere/results/claims/packet_delays.csv"
    assert LAYOUT.page("diff.csv") == "somewhere/results/diff.csv"


def test_the_log_and_the_timing_of_a_job_have_the_same_parts():
    parts = ("table", "radar")
    assert LAYOUT.job_log(*parts) == "somewhere/results/job_logs/table/radar.log"
    assert LAYOUT.timing(*parts) == "somewhere/results/timings/table/radar.tsv"
