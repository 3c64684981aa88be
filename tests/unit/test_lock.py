"""A killed run's locks and part files go; those of a run that may be alive stay."""

import errno
import fcntl
import os
import subprocess

import pytest

from repro.errors import ReproError
from repro.workflow import lock
from repro.workflow.lock import Mark, hold, runs_jobs, sweep

HOST = os.uname().nodename


@pytest.fixture
def clone(tmp_path, monkeypatch):
    """A clone with a lock of Snakemake in it."""
    place = tmp_path / "clone"
    (place / ".snakemake/locks").mkdir(parents=True)
    (place / ".snakemake/locks/0.input.lock").write_text("")
    monkeypatch.chdir(place)
    return place


@pytest.fixture
def alive():
    process = subprocess.Popen(["sleep", "60"])
    yield process
    process.kill()
    process.wait()


def mark(process, folders, host=HOST, clone="/other", started=None):
    """The marks of a process, as it would have written them."""
    started = started or lock._started(process.pid)
    files = [folder / f"{host}.{process.pid}" for folder in folders]
    of_run = Mark(host, process.pid, started, str(clone), [str(file) for file in files])
    for file in files:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(lock.json.dumps(of_run._asdict()))
    return files


def start(clone):
    """Whether the lock of Snakemake is still there after the start of a run."""
    hold(".snakemake", "results")
    assert (clone / f".snakemake/runs/{HOST}.{os.getpid()}").exists()
    return (clone / ".snakemake/locks/0.input.lock").exists()


def test_locks_of_a_run_that_is_alive_stay_until_it_is_dead(clone, alive):
    (file,) = mark(alive, [clone / ".snakemake/runs"], clone=clone)
    assert start(clone)
    alive.kill()
    os.waitid(os.P_PID, alive.pid, os.WEXITED | os.WNOWAIT)  # a zombie, as without an init
    assert not start(clone) and not file.exists()


def test_a_later_process_with_the_same_number_is_not_taken_for_the_run(clone, alive):
    mark(alive, [clone / ".snakemake/runs"], started="long ago")
    assert not start(clone)


def test_another_host_is_never_taken_for_dead(clone, alive):
    (file,) = mark(alive, [clone / ".snakemake/runs"], host="elsewhere", started="then")
    assert start(clone) and file.exists()


def test_a_file_system_without_flock_is_no_error(clone, monkeypatch):
    def missing(*_):
        raise OSError(errno.ENOSYS, "Function not implemented")

    monkeypatch.setattr(fcntl, "flock", missing)
    assert not start(clone)


@pytest.mark.parametrize(("host", "folder"), [(HOST, "/other"), ("elsewhere", None)])
def test_two_runs_in_one_folder_of_results_are_refused(host, folder, clone, alive):
    folder = folder or clone  # the same clone, seen from another host
    files = mark(alive, [clone / "results/.runs", clone / "kept"], host=host, clone=folder)
    with pytest.raises(ReproError) as error:
        hold(".snakemake", "results")
    line = str(error.value)
    assert f"results: a run in {folder} on host {host}, process {alive.pid}, writes there" in line
    assert f"if it has ended: rm {files[0]} {files[1]}" in line and "\n" not in line
    assert not (clone / f".snakemake/runs/{HOST}.{os.getpid()}").exists()
    for file in files:
        file.unlink()
    assert not start(clone)


def test_a_second_run_of_the_same_clone_is_left_to_snakemakes_locks(clone, alive):
    mark(alive, [clone / "results/.runs", clone / ".snakemake/runs"], clone=clone)
    assert start(clone)


def test_a_mark_that_cannot_be_read_is_kept_and_named(clone):
    (clone / "results/.runs").mkdir(parents=True)
    (clone / "results/.runs/x").write_text("{")
    with pytest.raises(ReproError, match=r"if it has ended: rm .*results/\.runs/x"):
        hold(".snakemake", "results")


@pytest.mark.parametrize(
    ("words", "runs"),
    [
        ("-j2", True),
        ("-j1 --config into=n", True),
        ("-np a.csv", False),
        ("--dry-run", False),
        ("--lint", False),
        ("--unlock", False),
        ("--report a.html", False),
    ],
)
def test_only_a_run_that_has_jobs_marks_itself(words, runs):
    assert runs_jobs(words.split()) == runs


def test_part_files_of_dead_processes_are_swept(tmp_path, alive):
    (tmp_path / "runs").mkdir()
    dead = subprocess.Popen(["true"])
    dead.wait()
    names = [f".{HOST}.{dead.pid}.0.npz", f".{HOST}.{alive.pid}.0.npz", f".other.{dead.pid}.0.npz"]
    names += ["0.npz", f".{HOST}.x.0.npz"]
    for name in names:
        (tmp_path / "runs" / name).write_text("")
    sweep(tmp_path)
    assert {file.name for file in (tmp_path / "runs").iterdir()} == set(names[1:])
