"""Two hosts in one folder: a run of another host keeps its mark and its locks."""

import json
from pathlib import Path

from repro.workflow.lock import Mark
from tests.torture.paper import COMMAND
from tests.workflow.conftest import Project


def marked_by_another_host(project: Project) -> list[Path]:
    """Mark a run of another host, with Snakemake's locks, as if the folder were shared."""
    records = project.folder / ".snakemake"
    files = [records / "runs/elsewhere.7", project.folder / "into/results/.runs/elsewhere.7"]
    mark = Mark("elsewhere", 7, "then", str(project.folder), [str(file) for file in files])
    locks = [records / f"locks/0.{kind}.lock" for kind in ("input", "output")]
    for file in (*files, *locks):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(mark._asdict()) if file in files else "")
    return [*files, *locks]


def faults_of_two_hosts(project: Project) -> list[str]:
    """What is wrong with how a run, and a dry one, take a run of another host."""
    left = marked_by_another_host(project)
    refused = project.snakemake(*COMMAND, fails=True)
    project.snakemake("-n", *COMMAND)
    faults = [f"removed: {file}" for file in left if not file.exists()]
    line = refused.splitlines()[-1]
    if not (line.startswith("error: ") and "on host elsewhere, process 7, writes there" in line):
        faults.append(f"not refused in one line: {line}")
    for file in line.partition(": rm ")[2].split():  # as the line says
        Path(file).unlink()
    project.snakemake(*COMMAND)
    return faults + [f"not cleared: {file}" for file in left if file.exists()]
