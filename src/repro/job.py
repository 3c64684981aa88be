"""What every job of the workflow does around its work: one line on bad input, and its usage."""

import resource
import sys
import time
from collections.abc import Callable
from pathlib import Path

from repro.errors import ReproError

USAGE = "usage:"


def job(log: str, work: Callable[[], object]) -> None:
    """Run `work`. The job's log file gets its CPU time and peak memory, or the one line of a fault."""
    try:
        work()
    except ReproError as error:
        Path(log).write_text(f"error: {error}\n")
        sys.exit(1)
    used = resource.getrusage(resource.RUSAGE_SELF)
    cpu = time.process_time()
    Path(log).write_text(f"{USAGE} cpu_s={cpu:.3f} peak_mb={used.ru_maxrss / 1024:.1f}\n")
