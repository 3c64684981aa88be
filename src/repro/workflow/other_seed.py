"""Everything up to the verdicts with another root seed, by a Snakemake in a folder of its own."""

import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from repro.atomic import atomic_write
from repro.errors import ReproError

LINKED = ("Snakefile", "workflow", "src", "params", "profiles", "figures")
DIFF = "results/diff.csv"


def run_seed(
    project: str | Path, config: Mapping[str, object], cores: int, path: str | Path
) -> None:
    """Write the diff of the project in the folder `project` with the values `config`.

    The run is in the folder of the path without its ending, where nothing stays of it. Raises
    ReproError with Snakemake's output if it fails.
    """
    folder = Path(path).with_suffix("")
    shutil.rmtree(folder, ignore_errors=True)  # of a run that was killed
    folder.mkdir(parents=True)
    for name in LINKED:
        folder.joinpath(name).symlink_to(Path(project, name).absolute())
    values = [f"{name}={value}" for name, value in config.items() if value is not None]
    command = [sys.executable, "-m", "snakemake", f"-j{cores}", DIFF, "--config", *values]
    run = subprocess.run(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    if run.returncode != 0:
        error = ReproError(f"{path}: Snakemake has failed with {', '.join(values)}")
        error.details = run.stdout
        raise error
    with atomic_write(path) as part:
        shutil.copyfile(folder / DIFF, part)
    shutil.rmtree(folder)
