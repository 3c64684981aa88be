"""A real Slurm of two nodes on this host's loopback, from files in a folder of its own."""

import os
import secrets
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

NODES = ("n1", "n2")

CONFIGURATION = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation={folder}/state
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdSpoolDir={folder}/spool.%n
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmdLogFile={folder}/slurmd.%n.log
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
MailProg=/bin/true
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerType=sched/backfill
SchedulerParameters=bf_interval=1,sched_interval=1
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MinJobAge=3600
KillWait=5
CompleteWait=0
ReturnToService=0
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 RealMemory=2000
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 RealMemory=2000
PartitionName=main Nodes=n1,n2 Default=YES State=UP
"""
NO_CGROUPS = "CgroupPlugin=cgroup/v1\nConstrainCores=no\nConstrainRAMSpace=no\n"


class Slurm:
    """A Slurm whose files are in `folder`, an empty one of root's."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.mark = f"SLURM_CONF={folder}/slurm.conf"
        name, value = self.mark.split("=")
        self.environment = os.environ | {name: value, "PATH": f"{folder}/bin:{os.environ['PATH']}"}

    def ask(self, *command: str) -> str:
        """What a command of Slurm prints. Raises CalledProcessError if it fails."""
        return subprocess.run(
            command, env=self.environment, capture_output=True, text=True, check=True, timeout=30
        ).stdout

    def running(self) -> list[tuple[str, str]]:
        """Number and node of every job that runs."""
        lines = self.ask("squeue", "-h", "-t", "RUNNING", "-o", "%i %N").splitlines()
        return [tuple(line.split()) for line in lines]

    def processes(self) -> dict[int, str]:
        """Every process that was started under this Slurm's configuration, daemons included."""
        processes = {}
        for process in Path("/proc").glob("[0-9]*"):
            try:
                if self.mark.encode() in (process / "environ").read_bytes().split(b"\0"):
                    processes[int(process.name)] = (process / "comm").read_text().strip()
            except (OSError, ValueError):
                continue  # ended meanwhile
        return processes

    @contextmanager
    def up(self) -> Iterator[None]:
        """Bring Slurm up; at the end take down every process of it, its jobs' included.

        Raises TimeoutError, with the output of the daemons, if it does not come up.
        """
        daemons = []
        try:
            _write_files(self.folder)
            files = [f"--{name}-file={self.folder}/munge.{name}" for name in ("key", "pid", "seed")]
            files += [f"--log-file={self.folder}/munge.log", f"--socket={self.folder}/munge.socket"]
            daemons.append(self._start("munged", "--foreground", *files))
            self._wait((self.folder / "munge.socket").exists)
            daemons.append(self._start("slurmctld", "-D"))
            daemons += [self._start("slurmd", "-D", "-N", node) for node in NODES]
            self._wait(self._answers)
            yield
        finally:
            for daemon in reversed(daemons):
                daemon.terminate()
                try:
                    daemon.wait(10)
                except subprocess.TimeoutExpired:
                    daemon.kill()
                    daemon.wait()
            self._end_jobs()

    def _end_jobs(self) -> None:
        """Kill what still runs under the configuration, until nothing does: for 10 s at most."""
        end = time.monotonic() + 10
        while (left := self.processes()) and time.monotonic() < end:
            for process in left:
                with suppress(ProcessLookupError):
                    os.kill(process, signal.SIGKILL)
            time.sleep(0.1)

    def _start(self, *command: str) -> subprocess.Popen:
        """A daemon as a child of this process, in a session that Ctrl-C does not reach."""
        with (self.folder / f"{command[0]}.out").open("a") as out:
            return subprocess.Popen(
                command, env=self.environment, stdout=out, stderr=out, start_new_session=True
            )

    def _answers(self) -> bool:
        try:
            if self.ask("sinfo", "-h", "-N", "-o", "%T").split() != ["idle"] * len(NODES):
                return False
            self.ask("srun", f"-N{len(NODES)}", "true")
        except subprocess.SubprocessError:
            return False
        return True

    def _wait(self, condition: Callable[[], bool]) -> None:
        end = time.monotonic() + 30
        while not condition():
            if time.monotonic() > end:
                output = "".join(path.read_text() for path in self.folder.glob("*.out"))
                raise TimeoutError(f"Slurm does not come up: {output}")
            time.sleep(0.2)


def _write_files(folder: Path) -> None:
    folder.chmod(0o711)  # munged wants its socket reachable, and its key not
    (folder / "state").mkdir()
    key = folder / "munge.key"
    key.touch(0o600)
    key.write_bytes(secrets.token_bytes(1024))
    host = socket.gethostname().split(".")[0]
    configuration = CONFIGURATION.format(folder=folder, host=host, ports=_free_ports(3))
    (folder / "slurm.conf").write_text(configuration)
    (folder / "cgroup.conf").write_text(NO_CGROUPS)
    # Snakemake's step in a job takes SLURM_* out of the environment before it calls srun.
    wrapper = folder / "bin" / "srun"
    wrapper.parent.mkdir()
    srun = shutil.which("srun")
    wrapper.write_text(f'#!/bin/sh\nSLURM_CONF={folder}/slurm.conf exec {srun} "$@"\n')
    wrapper.chmod(0o755)


def _free_ports(count: int) -> list[int]:
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [opened.getsockname()[1] for opened in sockets]
    for opened in sockets:
        opened.close()
    return ports
