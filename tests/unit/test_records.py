"""Results of which Snakemake has no record are checked for where they come from."""

from pathlib import Path

import numpy as np
import pytest

from repro.errors import ReproError
from repro.layout import Layout
from repro.logs import write_log
from repro.origin import origin
from repro.provenance.manifest import write_manifest
from repro.provenance.records import Records
from repro.statistics.runs import Runs, RunsWriter
from tests.conftest import small_log

STUDY, POINT = "linear_delays", "arrival=0.5"
MADE = {STUDY: {POINT: {"trials": 3, "log_of": POINT, "log": "1", "filters": {"omvf": "2"}}}}


@pytest.fixture
def layout(tmp_path):
    """A log, runs, a table and a manifest, made under records that are lost."""
    layout = Layout(tmp_path / "results")
    log, runs = layout.log(STUDY, POINT, 0), layout.run(STUDY, "main", "omvf", 0)
    table = layout.table(STUDY)
    for file in (log, runs, table):
        Path(file).parent.mkdir(parents=True)
    write_log(log, small_log(STUDY, POINT, 3, 6), 1.0, origin=origin("1", (0, 3)))
    with Path(runs).open("wb") as stream, RunsWriter(stream) as writer:
        errors = Runs(np.zeros((3, 7, 2)), None, np.zeros(3), recorded={})
        writer.add(POINT, errors, origin("2", (0, 3)))
    Path(table).write_text("x\n")
    write_manifest(layout.page("manifest.json"), "c", "code", 1, [], [table])
    Records(tmp_path / "lost", layout).take()
    return layout


def check(layout, made, code="code"):
    records = Records(layout.root.parent / "own", layout)
    records.check(lambda: made, 1, lambda: code)
    records.take()


def changed(**of_point):
    return {STUDY: {POINT: MADE[STUDY][POINT] | of_point}}


def test_what_a_run_would_make_is_taken_over_once(layout):
    check(layout, MADE)
    check(layout, changed(trials=9))  # of the same records: Snakemake knows what to do


@pytest.mark.parametrize(
    ("made", "code", "fault"),
    [
        (changed(trials=2), "code", r"0\.mcap: stale: it has trials 0 to 2, and trials 0 to 1 are"),
        (changed(log="3"), "code", r"0\.mcap: stale: it was made with other parameters"),
        (changed(filters={"omvf": "3"}), "code", r"0\.npz, arrival=0\.5: stale: it was made with"),
        (MADE, "other", r"linear_delays\.csv: stale: made by other code"),
    ],
)
def test_what_is_stale_is_refused(layout, made, code, fault):
    for _ in range(2):  # and stays so
        with pytest.raises(ReproError, match=f"{fault}.*another clone, or .snakemake is lost"):
            check(layout, made, code)


def test_a_table_that_has_changed_is_refused(layout):
    Path(layout.table(STUDY)).write_text("y\n")
    with pytest.raises(ReproError, match="files differ from the manifest"):
        check(layout, MADE)


def test_a_table_without_a_manifest_is_refused(layout):
    Path(layout.page("manifest.json")).unlink()
    with pytest.raises(ReproError, match="of a run that was not completed"):
        check(layout, MADE)
