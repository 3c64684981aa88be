"""Kills of a run at any moment; the same command must end with the bytes of an undisturbed run."""

import os
import random
import shutil
import signal
import subprocess
import time
from collections.abc import Callable

import psutil

from tests.torture.paper import COMMAND, RESULTS
from tests.workflow.conftest import Project


def kill_group(run: subprocess.Popen, _: random.Random) -> None:
    """All processes of the run, as a machine that is switched off."""
    os.killpg(run.pid, signal.SIGKILL)


def kill_engine(run: subprocess.Popen, _: random.Random) -> None:
    """Snakemake alone: its jobs live on as orphans."""
    run.send_signal(signal.SIGKILL)


def kill_job(run: subprocess.Popen, chance: random.Random) -> None:
    """One job alone, as a system that is short of memory does; Snakemake itself goes on."""
    jobs = psutil.Process(run.pid).children(recursive=True)
    if jobs:
        chance.choice(jobs).kill()


KILLS: dict[str, Callable] = {"group": kill_group, "engine": kill_engine, "job": kill_job}


def undisturbed(project: Project) -> dict[str, bytes]:
    """The results of a run that nobody kills; they are removed again."""
    project.snakemake(*COMMAND)
    files = project.bytes_of(*RESULTS)
    assert {path.rpartition(".")[2] for path in files} == {"mcap", "npz", "csv", "md", "png"}
    clear(project)
    return files


def clear(project: Project) -> None:
    """As before the first run."""
    for name in ("into", ".snakemake"):
        shutil.rmtree(project.folder / name, ignore_errors=True)


def kill_and_resume(
    project: Project, expected: dict[str, bytes], kind: str, chance: random.Random
) -> tuple[str, list[str]]:
    """Kill a run and resume it; the moment of the kill, and the faults of what is left then."""
    results, later = chance.randrange(len(expected)), chance.uniform(0, 1)
    run = project.start(*COMMAND)
    while run.poll() is None and len(project.bytes_of(*RESULTS)) < results:
        time.sleep(0.05)
    time.sleep(later)
    jobs = []
    if run.poll() is None:
        jobs = psutil.Process(run.pid).children(recursive=True)
        KILLS[kind](run, chance)
    if kind == "job":
        run.communicate(timeout=600)
    else:
        run.wait()  # its pipe may be held by orphans
    project.snakemake(*COMMAND)
    _, alive = psutil.wait_procs(jobs, timeout=120)
    faults = [f"a process of the killed run lives: {job}" for job in alive]
    moment = f"{later:.2f} s after {results} of {len(expected)} results"
    return moment, [*faults, *differences(project, expected)]


def differences(project: Project, expected: dict[str, bytes]) -> list[str]:
    """Results that are not those of an undisturbed run, part files, and marks that are left."""
    found = project.bytes_of(*RESULTS)
    paths = sorted(found.keys() | expected.keys())
    faults = [f"differs: {path}" for path in paths if found.get(path) != expected.get(path)]
    hidden = project.bytes_of("into/**/.*.*", "into/results/.runs/*", ".snakemake/runs/*")
    return faults + [f"left behind: {path}" for path in hidden]
