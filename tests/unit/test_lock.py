"""A killed run's locks go; those of a run that is alive stay."""

from repro.workflow.lock import hold


def test_locks_go_when_no_process_is_alive_and_stay_otherwise(tmp_path):
    lock = tmp_path / "locks" / "0.input.lock"
    lock.parent.mkdir()
    lock.write_text("")
    with hold(tmp_path):
        assert not lock.exists()
        lock.write_text("")
        hold(tmp_path).close()
        assert lock.exists()
    hold(tmp_path).close()
    assert not lock.exists()
