"""A job's end: its usage, or one line on a fault."""

import tempfile

import pytest

from repro.errors import ReproError
from repro.runner.faults import FilterError
from repro.workflow.job import USAGE, job


def test_usage_is_logged(tmp_path):
    with job(tmp_path / "log"):
        sum(range(1000))
    assert (tmp_path / "log").read_text().startswith(USAGE)


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        (ReproError("a.mcap: topic /x: missing"), "error: a.mcap: topic /x: missing"),
        (
            OSError(28, "No space left on device", "a.npz"),
            "error: a.npz: No space left on device: fix it and run again",
        ),
        (
            OSError(28, "No space left on device"),  # as of a temporary file, which has no name
            f"error: temporary files in {tempfile.gettempdir()} (TMPDIR names another folder): "
            "No space left on device: fix it and run again",
        ),
        (
            MemoryError("Unable to allocate 7 TiB"),
            "error: memory is full (Unable to allocate 7 TiB): take fewer trials, or split them "
            "with --config shards=N",
        ),
    ],
)
def test_a_fault_ends_in_one_line(fault, message, tmp_path):
    with pytest.raises(SystemExit) as ended, job(tmp_path / "log"):
        raise fault
    assert str(ended.value) == message
    assert (tmp_path / "log").read_text() == message + "\n"


def test_a_log_on_the_full_disk_is_no_second_fault(tmp_path):
    with (
        pytest.raises(SystemExit, match=r"a\.npz: No space left"),
        job(tmp_path / "no folder" / "log"),
    ):
        raise OSError(28, "No space left on device", "a.npz")


def test_the_traceback_of_a_filter_comes_before_the_line(tmp_path, capsys):
    fault = FilterError("filter mine: ZeroDivisionError", '  File "mine.py", line 3, in step\n')
    with pytest.raises(SystemExit, match="error: filter mine"), job(tmp_path / "log"):
        raise fault
    assert capsys.readouterr().err == fault.details
