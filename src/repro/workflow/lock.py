"""Marks of the runs that are alive; what a killed run has left is removed, and nothing else."""

import atexit
import contextlib
import io
import json
import os
import re
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from repro.atomic import MARK, atomic_write, pid_of_part
from repro.errors import ReproError

UNKNOWN = "unknown"  # the start of a process of another user, where the system hides it
# Options of Snakemake with which it runs no job.
ONLY_ASKS = (
    "dryrun lint list_rules list_target_rules print_compilation dag rulegraph filegraph d3dag "
    "summary detailed_summary list_changes list_input_changes list_params_changes list_untracked "
    "list_conda_envs unlock"
).split()

# Words that may stand for one of these options: only then is the whole command line parsed.
MAY_ONLY_ASK = re.compile(
    r"-[a-zA-Z]*[nlSD]|--(dry|lint|list|print|dag|rule|file|d3|summ|detail|unlock|report)"
)


class Mark(NamedTuple):
    """A run of Snakemake that writes results."""

    host: str
    pid: int
    started: str  # tells the process from a later one with the same number
    clone: str  # the folder that it was started in
    files: list[str]  # where the mark is

    def is_dead(self) -> bool:
        """Whether the run has certainly ended: only a process of this host can be seen."""
        return self.host == os.uname().nodename and _has_ended(self.pid, self.started)


def runs_jobs(words: Sequence[str]) -> bool:
    """Whether Snakemake with these words of its command line runs jobs, unlike with -n."""
    if not any(MAY_ONLY_ASK.match(word) for word in words):
        return True
    from snakemake.cli import parse_args  # of the main process alone

    with contextlib.redirect_stderr(io.StringIO()):  # Snakemake has named its profile already
        _, options = parse_args(words)
    report_alone = getattr(options, "report", None) and not options.report_after_run
    return not (report_alone or any(getattr(options, name, None) for name in ONLY_ASKS))


def hold(records: str | Path, *results: str | Path) -> None:
    """Mark this process as a run in Snakemake's folder of records, and in that of the results.

    The marks go when the process ends; those of a killed one stay until the next run of its host
    finds it dead, and with the last mark go the locks of Snakemake, which outlive a SIGKILL.
    Raises ReproError if a run of another clone or host may be writing into the results, and
    OSError if a folder cannot be written.
    """
    here, clone = os.uname().nodename, str(Path.cwd())
    name = f"{here}.{os.getpid()}"
    of_clone = Path(records).absolute() / "runs"
    of_results = [Path(folder).absolute() / ".runs" for folder in results]
    files = [folder / name for folder in (of_clone, *of_results)]
    started = _started(os.getpid()) or UNKNOWN
    mark = Mark(here, os.getpid(), started, clone, [str(file) for file in files])
    locks = list((Path(records) / "locks").glob("*.lock"))
    for file in files:
        file.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(file) as part:
            part.write_text(json.dumps(mark._asdict()), encoding="utf-8")
    atexit.register(_remove, mark, os.getpid())
    for folder in of_results:
        for other in _others(folder, name):
            if (other.host, other.clone) != (here, clone):
                _remove(mark, os.getpid())
                raise ReproError(_refusal(other, folder.parent))
    os.environ[MARK] = str(files[-1])
    # A run that has marked itself in the meantime has other locks than those found above.
    if not _others(of_clone, name):
        for left in locks:
            left.unlink(missing_ok=True)


def sweep(folder: str | Path) -> None:
    """Remove the part files that killed processes of this host have left below a folder."""
    for place, _, names in os.walk(folder):
        for name in names:
            pid = pid_of_part(name)
            if pid is not None and _started(pid) is None:
                Path(place, name).unlink(missing_ok=True)


def _others(folder: Path, own: str) -> list[Mark]:
    """Marks in a folder of runs that may be alive; those of dead ones are removed."""
    alive = []
    for file in sorted(folder.glob("[!.]*")):
        if file.name != own:
            mark = _read(file)
            if mark.is_dead():
                file.unlink(missing_ok=True)
            else:
                alive.append(mark)
    return alive


def _read(file: Path) -> Mark:
    try:
        content: Any = json.loads(file.read_text(encoding="utf-8"))
        return Mark(**content)
    except (ValueError, TypeError):  # written by something else
        return Mark(UNKNOWN, 0, UNKNOWN, UNKNOWN, [str(file)])


def _refusal(other: Mark, results: Path) -> str:
    return (
        f"{results}: a run in {other.clone} on host {other.host}, process {other.pid}, writes "
        f"there: wait for it, or write elsewhere with --config into=FOLDER; if it has ended: "
        f"rm {' '.join(other.files)}"
    )


def _remove(mark: Mark, pid: int) -> None:
    if os.getpid() == pid:  # not in a forked child
        for file in mark.files:
            Path(file).unlink(missing_ok=True)


def _has_ended(pid: int, started: str) -> bool:
    now = _started(pid)
    return now is None or (now != started and UNKNOWN not in (now, started))


def _started(pid: int) -> str | None:
    """When a process of this host started, in the system's words; None if it has ended."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return None
    except PermissionError:
        pass  # of another user
    if Path("/proc/self/stat").exists():
        try:
            boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="utf-8").strip()
            stat = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace")
        except OSError:
            return UNKNOWN
        state, *fields = stat.rpartition(")")[2].split()
        return None if state in "ZX" else f"{boot} {fields[18]}"  # a zombie does nothing more
    # macOS
    command = ["ps", "-o", "lstart=", "-p", str(pid)]
    environment = os.environ | {"LC_ALL": "C"}
    told = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    return told.stdout.strip() or None
