"""Removes the locks of a killed run, and leaves those of a run that is alive."""

import fcntl
from pathlib import Path
from typing import TextIO


def hold(folder: str | Path) -> TextIO:
    """Mark this process as alive in Snakemake's `folder`; remove its locks if no other is.

    Snakemake's locks are files, which outlive a SIGKILL; the mark is an flock, which ends with its
    process. It is held as long as the returned file is open.
    """
    folder = Path(folder)
    folder.mkdir(exist_ok=True)
    mark = (folder / "alive").open("a")
    try:
        fcntl.flock(mark, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        pass  # another run is alive and needs its locks
    else:
        for left in (folder / "locks").glob("*.lock"):
            left.unlink(missing_ok=True)
    fcntl.flock(mark, fcntl.LOCK_SH)
    return mark
