"""A result file appears complete, or not at all."""

import pytest

from repro.atomic import MARK, atomic_write, check_writable
from repro.errors import ReproError


def test_the_old_result_stays_until_the_new_one_is_complete(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("old")
    with pytest.raises(RuntimeError), atomic_write(path) as part:
        part.write_text("half")
        raise RuntimeError
    assert [file.name for file in tmp_path.iterdir()] == ["a.csv"] and path.read_text() == "old"
    with atomic_write(path) as part:
        part.write_text("new")
        assert path.read_text() == "old"
    assert [file.name for file in tmp_path.iterdir()] == ["a.csv"] and path.read_text() == "new"


def test_an_error_in_writing_names_the_result(tmp_path):
    with (
        pytest.raises(OSError, match=r"missing/a\.csv") as error,
        atomic_write(tmp_path / "missing/a.csv") as part,
    ):
        part.write_text("new")
    assert error.value.filename == str(tmp_path / "missing/a.csv")


def test_a_place_that_cannot_take_results_is_named(tmp_path):
    check_writable(tmp_path / "not/yet/there")
    (tmp_path / "file").write_text("")
    with pytest.raises(ReproError, match=r"/file: not a folder that can be written, as .*/results"):
        check_writable(tmp_path / "file/results")


def test_a_job_whose_run_is_over_publishes_nothing(tmp_path, monkeypatch):
    """An orphan of a killed run could put its result over that of a later one."""
    mark, result = tmp_path / "mark", tmp_path / "result"
    monkeypatch.setenv(MARK, str(mark))
    mark.touch()
    for text in ("first", "second"):
        with atomic_write(result) as part:
            part.write_text(text)
    mark.unlink()
    fault = "not written: the run that began this job is over"
    with pytest.raises(ReproError, match=fault), atomic_write(result) as part:
        part.write_text("third")
    assert result.read_text() == "second" and [*tmp_path.iterdir()] == [result]
