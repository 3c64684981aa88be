"""Result files that appear complete, or not at all."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from repro.errors import ReproError

MARK = "REPRO_RUN_MARK"  # environment variable: the mark of the run that a job belongs to


def check_writable(folder: str | Path) -> None:
    """Raise ReproError unless results can be written into the folder, which need not exist yet."""
    there = Path(folder).absolute()
    while not there.exists():
        there = there.parent
    if not (there.is_dir() and os.access(there, os.W_OK | os.X_OK)):
        raise ReproError(
            f"{there}: not a folder that can be written, as {folder} asks for; "
            "fix it, or write elsewhere with --config into=FOLDER"
        )


@contextmanager
def atomic_write(path: str | Path) -> Iterator[Path]:
    """A path to write a result to, which takes its name at the end of the block.

    Each process writes to a temporary file of its own, and a job that outlives its run publishes
    nothing once a later run has begun: it could put its result over a newer one. An OSError names
    the result. Raises ReproError if the run is over.
    """
    path = Path(path)
    part = path.with_name(f".{os.uname().nodename}.{os.getpid()}.{path.name}")
    try:
        yield part
        mark = os.environ.get(MARK)
        if mark is not None and not Path(mark).exists():
            raise ReproError(f"{path}: not written: the run that began this job is over ({mark})")
        part.replace(path)
    except OSError as error:
        if error.filename is None or str(error.filename) == str(part):
            raise OSError(error.errno, error.strerror, str(path)) from None
        raise
    finally:
        part.unlink(missing_ok=True)


def pid_of_part(name: str) -> int | None:
    """The process of this host that writes to a file of this name; None for any other file."""
    begins = f".{os.uname().nodename}."
    pid, dot, _ = name.removeprefix(begins).partition(".")
    return int(pid) if name.startswith(begins) and dot and pid.isdecimal() else None
