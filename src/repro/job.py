"""What every job of the workflow does around its work: one line on bad input, and its usage."""

import resource
import sys
import time
from collections.abc import Callable
from pathlib import Path

from repro.errors import ReproError

USAGE = "usage:"


def job(log: str, work: Callable[[], object]) -> None:
    """Run `work`; the job's log file gets its CPU time and peak memory, or one line on a fault."""
    try:
        work()
    except ReproError as error:
        Path(log).write_text(f"error: {error}\n")
        sys.exit(f"error: {error}")
    Path(log).write_text(f"{USAGE} cpu_s={time.process_time():.3f} peak_mb={_peak_mb():.1f}\n")


def _peak_mb() -> float:
    """Peak resident memory. getrusage would count what the process that started this one held."""
    status = Path("/proc/self/status")
    if status.exists():
        line = next(line for line in status.read_text().splitlines() if line.startswith("VmHWM"))
        return int(line.split()[1]) / 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
