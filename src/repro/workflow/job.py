"""What all jobs of the workflow share: one line on bad input, and a record of their usage."""

import errno
import resource
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NoReturn

from repro.errors import ReproError

USAGE, OF_POINT = "usage:", "point "


class Usage:
    """What a job says of its usage besides its CPU time and memory."""

    of_points: Mapping[str, float]  # CPU seconds of each point that it ran

    def __init__(self) -> None:
        self.of_points = {}


@contextmanager
def job(log: str | Path) -> Iterator[Usage]:
    """Runs a job's work; its log file gets CPU time and peak memory, or one line on bad input.

    Raises SystemExit with that line for a ReproError, an OSError or a MemoryError.
    """
    usage = Usage()
    try:
        yield usage
        lines = [f"{USAGE} cpu_s={time.process_time():.3f} peak_mb={_peak_mb():.1f}"]
        lines += [f"{OF_POINT}{p}: cpu_s={s:.4f}" for p, s in usage.of_points.items()]
        Path(log).write_text("\n".join(lines) + "\n", encoding="utf-8")
    except ReproError as error:
        print(error.details, end="", file=sys.stderr)
        _end(log, str(error))
    except OSError as error:  # a full disk, a folder that cannot be written
        what = error.filename or _unnamed(error)
        _end(log, f"{what}: {error.strerror or error}: fix it and run again")
    except MemoryError as error:
        _end(
            log,
            f"memory is full ({error or 'no more can be had'}): take fewer trials, or split them "
            "with --config shards=N",
        )


def _unnamed(error: OSError) -> str:
    """What an error is about that names no file: results are named, temporary files are not."""
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        return f"temporary files in {tempfile.gettempdir()} (TMPDIR names another folder)"
    return "a result"


def _end(log: str | Path, fault: str) -> NoReturn:
    with suppress(OSError):  # the log may be on the same full disk
        Path(log).write_text(f"error: {fault}\n", encoding="utf-8")
    sys.exit(f"error: {fault}")


def _peak_mb() -> float:
    """Peak resident memory. getrusage would include that of the process that started this one."""
    status = Path("/proc/self/status")
    if status.exists():
        line = next(
            line
            for line in status.read_text(encoding="utf-8").splitlines()
            if line.startswith("VmHWM")
        )
        return int(line.split()[1]) / 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
