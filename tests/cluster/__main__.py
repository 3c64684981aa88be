"""The pipeline on a real Slurm: python -m tests.cluster

Runs where Slurm is, or where root can install it with apt-get; elsewhere it is skipped.
"""

import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from tests.cluster.slurm import Slurm
from tests.workflow.conftest import Project

PACKAGES = ("slurmctld", "slurmd", "slurm-client", "munge")
PROGRAMS = ("slurmctld", "slurmd", "srun", "munged")

# One study each of Kalman and particle filters, of a censored network and in a closed loop.
STUDIES = ("linear_delays", "ungm", "deadband", "quadrotor")
FILTERS = ("omvf", "sun", "pf_ross_eh", "mapf", "mpf", "bkf_1", "true_state")
TABLES = [f"smoke/results/tables/{study}.csv" for study in STUDIES]
ALONE = "runs/deadband/main/mapf"  # the results of one job,
NEEDS_IT = "tables/deadband.csv"  # and those of another, without which the first would not run
FIGURE = "smoke/figures/studies/linear_delays/over_k.png"
RESULTS = (
    "logs/*/*/*.mcap",
    "runs/*/*/*/*.npz",
    "tables/*.csv",
    "curves/*",
)


class Copy(Project):
    """A copy with a point and two filters of each study: few and short jobs."""

    options = ("-j2", "--profile", "profiles/smoke")

    def __init__(self, folder: Path, cluster: Slurm):
        folder.mkdir()
        super().__init__(folder)
        self.cluster = cluster
        self.environment = cluster.environment  # by which its processes are found at the end
        self.keep_only("packet_delays", "linear_delays", ["arrival=0.5", "arrival=0.9"])
        self.keep_first("energy_harvesting", "ungm")
        self.keep_first("unknown_losses", "quadrotor")
        self.keep_filters(*FILTERS)

    def results(self) -> dict[str, bytes]:
        return self.bytes_of(*(f"smoke/results/{pattern}" for pattern in RESULTS), FIGURE)


class OnSlurm(Copy):
    """The same command with Slurm's profile; polls the jobs more often, to be quick."""

    options = (
        *("--profile", "profiles/smoke", "--workflow-profile", "profiles/slurm"),
        *("--seconds-between-status-checks", "1"),
        *("--slurm-init-seconds-before-status-checks", "1"),
    )

    def forget(self) -> None:
        """Remove the results of one job, and of one that needs it."""
        shutil.rmtree(self.folder / "smoke/results" / ALONE)
        (self.folder / "smoke/results" / NEEDS_IT).unlink()

    def start_and_wait_for_its_job(self) -> tuple[subprocess.Popen, str, str]:
        """Start what is not done yet; returns in the middle of its job, with job and node."""
        run = self.start(*TABLES, FIGURE)
        wait(self.cluster.running, "the job")
        ((job, node),) = self.cluster.running()
        return run, job, node


def check_tables(local: Copy, remote: OnSlurm) -> str:
    begun = time.monotonic()
    local.snakemake(*TABLES, FIGURE)
    alone = time.monotonic() - begun
    output = remote.snakemake(*TABLES, FIGURE)
    took = time.monotonic() - begun - alone
    expected = local.results()
    assert len(expected) > len(TABLES) and remote.results() == expected, "not the same bytes"
    assert "Nothing to be done" in remote.snakemake(*TABLES, FIGURE)
    jobs, submitted = (output.count(f"{event} jobid") for event in ("Finished", "with SLURM"))
    return (
        f"{len(expected)} files as of a local run, byte for byte: {jobs} jobs in {submitted} of "
        f"Slurm's, {took:.0f} s (local {alone:.0f} s)"
    )


def check_cancelled(local: Copy, remote: OnSlurm) -> str:
    remote.forget()
    run, job, node = remote.start_and_wait_for_its_job()
    remote.cluster.ask("scancel", job)
    output, _ = run.communicate(timeout=120)
    assert run.returncode != 0 and f"JOB {job} ON {node} CANCELLED" in output, output
    return "a job ended by scancel ends the run with an error"


def check_node_down(local: Copy, remote: OnSlurm) -> str:
    """The same command after scancel resumes, and its job loses its node."""
    cluster = remote.cluster
    run, job, node = remote.start_and_wait_for_its_job()
    cluster.ask("scontrol", "update", f"nodename={node}", "state=DOWN", "reason=test")
    # Slurm holds a job that lost its node for two minutes; its first copy may live on meanwhile.
    wait(
        lambda: cluster.ask("squeue", "-h", "-j", job, "-o", "%r").strip() == "BeginTime", "requeue"
    )
    cluster.ask("scontrol", "update", f"jobid={job}", "starttime=now")
    output, _ = run.communicate(timeout=180)
    assert run.returncode == 0, output
    assert remote.results() == local.results(), "not the same bytes"
    shown = cluster.ask("scontrol", "show", "job", job)
    assert "Restarts=1" in shown and f" NodeList={node}\n" not in shown, shown
    return (
        "the same command resumes; with a node set DOWN in mid-run it completes with the same bytes"
    )


def wait(condition: Callable[[], object], event: str) -> None:
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end, f"{event} did not come within 60 s"
        time.sleep(0.1)


def why_not() -> str:
    """Why there can be no Slurm here; empty if there is one now."""
    if os.geteuid() != 0:
        return "Slurm's daemons are started by root here, and this is not root"
    if not importlib.util.find_spec("snakemake_executor_plugin_slurm"):
        return "pip install -c constraints.txt -e '.[cluster]' has not been run"
    if all(map(shutil.which, PROGRAMS)):
        return ""
    if not shutil.which("apt-get"):
        return "neither Slurm nor apt-get is here"
    install = ["install", "-y", "-q", "--no-install-recommends", *PACKAGES]
    for arguments in (["update", "-q"], install):
        try:
            subprocess.run(["apt-get", *arguments], check=True, capture_output=True, timeout=180)
        except subprocess.SubprocessError as error:
            return f"Slurm could not be installed: {error}"
    return ""


def main() -> int:
    reason = why_not()
    if reason:
        print(f"skipped: {reason}")
        return 0
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # as Ctrl-C: Slurm is taken down
    begun = time.monotonic()
    failed = False

    def report(line: str) -> None:
        print(f"{time.monotonic() - begun:4.0f} s  {line}", flush=True)

    with tempfile.TemporaryDirectory(prefix="slurm-") as name:
        folder = Path(name)
        cluster = Slurm(folder)
        try:
            with cluster.up():
                report("Slurm is up, with two nodes")
                local, remote = Copy(folder / "local", cluster), OnSlurm(folder / "remote", cluster)
                for check in (check_tables, check_cancelled, check_node_down):
                    report(f"ok: {check(local, remote)}")
        except (AssertionError, TimeoutError, subprocess.SubprocessError) as error:
            report(f"FAILED: {error}")
            failed = True
        except KeyboardInterrupt:
            report("FAILED: stopped")
            failed = True
        left = cluster.processes()
        report(
            f"FAILED: still running: {left}"
            if left
            else "ok: Slurm is down, and no process remains"
        )
    return int(failed or bool(left))


if __name__ == "__main__":
    sys.exit(main())
