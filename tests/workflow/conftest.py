"""A copy of the project with few points, in which Snakemake runs for real."""

import fcntl
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest
import yaml

from repro.parameters.load import load_paper
from tests.conftest import ROOT

KEPT = ["Snakefile", "workflow", "src", "params", "profiles", "figures"]
MACHINE_CODE = "src/repro/kernels/__pycache__"


class Project:
    """A folder with the project in it."""

    options = ("-j2",)
    environment = os.environ

    def __init__(self, folder: Path, original: Path = ROOT):
        """A copy of the project; or of such a copy, with what Snakemake has made in it."""
        self.folder = folder
        if original != ROOT:
            shutil.copytree(original, folder, symlinks=True, dirs_exist_ok=True)
            return
        for name in KEPT:
            source = ROOT / name
            if source.is_dir():
                ignored = shutil.ignore_patterns("__pycache__", "*.png", "*.egg-info")
                shutil.copytree(source, folder / name, ignore=ignored)
            else:
                shutil.copy(source, folder / name)
        # Every copy would compile the kernels anew, for longer than its jobs take.
        (ROOT / MACHINE_CODE).mkdir(exist_ok=True)
        (folder / MACHINE_CODE).symlink_to(ROOT / MACHINE_CODE)

    def snakemake(self, *arguments: str, fails: bool = False) -> str:
        """Run Snakemake; returns its output."""
        run = self.start(*arguments)
        output, _ = run.communicate(timeout=600)
        assert (run.returncode != 0) == fails, output
        return output

    def start(self, *arguments: str) -> subprocess.Popen:
        """Start Snakemake, in a process group of its own."""
        return subprocess.Popen(
            [sys.executable, "-m", "snakemake", *self.options, *arguments],
            cwd=self.folder,
            env={k: v for k, v in self.environment.items() if k != "PYTHONPATH"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )

    def pytest(self, *arguments: str) -> str:
        """Run tests of this project in the copy; returns their output."""
        (self.folder / "tests").mkdir(exist_ok=True)
        for name in ("tests/__init__.py", "tests/conftest.py", "tests/contract", "pyproject.toml"):
            if (ROOT / name).is_dir():
                ignored = shutil.ignore_patterns("__pycache__")
                shutil.copytree(ROOT / name, self.folder / name, ignore=ignored, dirs_exist_ok=True)
            else:
                shutil.copy(ROOT / name, self.folder / name)
        run = subprocess.run(
            [sys.executable, "-m", "pytest", "-n0", *arguments],
            cwd=self.folder,
            env={k: v for k, v in self.environment.items() if k != "PYTHONPATH"},
            capture_output=True,
            text=True,
        )
        assert run.returncode == 0, run.stdout + run.stderr
        return run.stdout

    def keep_only(self, paper: str, study: str, points: Sequence[str]) -> None:
        """Leave a study only a few points of its sweep over the arrival probability."""
        with self._families(paper, study) as families:
            families[:] = [_fixed(point, families) for point in points]

    def keep_first(self, paper: str, study: str) -> None:
        """Leave a study only the first of its points, which is no sweep."""
        with self._families(paper, study) as families:
            del families[1:]

    def keep_values(self, paper: str, study: str, **values: list[float]) -> None:
        """Leave the first family of a study a few values of its sweep."""
        with self._families(paper, study) as families:
            assert families[0]["sweep"].keys() == values.keys()
            families[0]["sweep"] = values

    def keep_families(self, paper: str, study: str, beginnings: list[str]) -> None:
        """Leave a study only the families whose names begin so."""
        with self._families(paper, study) as families:
            families[:] = [f for f in families if f["name"].startswith(tuple(beginnings))]

    def keep_filters(self, *names: str) -> None:
        """Leave only the rules of these filters."""
        rules = self.folder / "workflow/rules/filters.smk"
        others = rf"^use rule run_filter as (?!(?:{'|'.join(names)}) ).*?(\n\n\n|\Z)"
        rules.write_text(re.sub(others, "", rules.read_text(), flags=re.DOTALL | re.MULTILINE))

    def judge_only(self, paper: str, *beginnings: str) -> None:
        """Leave the diff only the items of one paper that begin so, claims among them.

        Its facts, and its tables that are tested as a whole, need more points than a few.
        """
        file = self.folder / f"params/published/{paper}.csv"
        head, *rows = file.read_text().splitlines(keepends=True)
        file.write_text(head + "".join(r for r in rows if r.startswith(beginnings)))
        module = self.folder / f"src/repro/papers/{paper}"
        for needs_all in ("facts.py", "tables.py"):
            (module / needs_all).unlink(missing_ok=True)
        claims = module / "claims/__init__.py"
        kept = f"CLAIMS[:] = [one for one in CLAIMS if one.item.startswith({beginnings})]\n"
        claims.write_text(f"{claims.read_text()}\n\n{kept}")

    def leave_only(self, *papers: str) -> None:
        """Take out the other papers: their parameters, published values, figures and rules."""
        others = [p.stem for p in (self.folder / "params/published").glob("*.csv")]
        snakefile = self.folder / "Snakefile"
        rules = snakefile.read_text()
        for other in set(others) - {*papers}:
            (self.folder / f"params/{other}.yaml").unlink()
            (self.folder / f"params/published/{other}.csv").unlink()
            shutil.rmtree(self.folder / "figures" / other)
            rules = rules.replace(f'include: "workflow/rules/papers/{other}.smk"\n', "")
        snakefile.write_text(rules)

    @contextmanager
    def _families(self, paper: str, study: str) -> Iterator[list[dict]]:
        """The families of a study's points, to change them in the copy."""
        file = self.folder / "params" / f"{paper}.yaml"
        content = yaml.safe_load(file.read_text())
        section = content["studies"][study]
        judged = section.pop("consistency", {})
        yield section["points"]
        file.write_text(yaml.safe_dump(content, sort_keys=False))
        left = load_paper(file).studies[study]
        section["consistency"] = {point: why for point, why in judged.items() if point in left}
        file.write_text(yaml.safe_dump(content, sort_keys=False))

    def bytes_of(self, *patterns: str) -> dict[str, bytes]:
        """Content of the files that match, by path."""
        return {
            str(path.relative_to(self.folder)): path.read_bytes()
            for pattern in patterns
            for path in sorted(self.folder.glob(pattern))
        }


def _fixed(point: str, families: list[dict]) -> dict:
    """A family of the one point `arrival=p` out of the swept family of that name."""
    (family,) = (f for f in families if f["name"] == "arrival={arrival_probability}")
    value = float(point.removeprefix("arrival="))
    return family | {"sweep": {"arrival_probability": [value]}}


POINTS = ("arrival=0.5", "arrival=0.9")
FILTERS = ("omvf", "nahi", "sun", "emvf")
FEW = ("--config", "trials=4")
# What `built` has; a figure that needs every step of the workflow before it among them.
STUDY = "linear_delays"
TABLE = f"results/tables/{STUDY}.csv"
STUDY_FIGURES = [
    f"figures/studies/{STUDY}/{kind}.png" for kind in ("over_k", "over_sweep", "distribution")
]
BUILT = (TABLE, *(f"figures/packet_delays/{name}.png" for name in ("fig01", "fig02", "table01")))
BUILT += (*STUDY_FIGURES, "results/parameters.csv")


def trimmed_paper(folder: Path, points: Sequence[str] = POINTS) -> Project:
    """A copy of the project with one paper, its claims and figures, of few and short jobs."""
    project = Project(folder)
    project.leave_only("packet_delays")
    project.keep_only("packet_delays", STUDY, points)
    project.keep_first("packet_delays", "wsn_tracking")
    few = {"packet_bound": [2], "arrival_probability": [0.9]}
    project.keep_values("packet_delays", "wsn_tracking", **few)
    project.judge_only("packet_delays", "Table 1: ", "Table 2: N=2 p=0.9,", "omvf-below-nahi")
    project.keep_filters(*FILTERS)
    return project


@pytest.fixture
def project(tmp_path):
    return Project(tmp_path)


@pytest.fixture
def trimmed(project):
    """The copy with two points of the linear study of packet delays."""
    project.keep_only("packet_delays", STUDY, POINTS)
    return project


@pytest.fixture
def paper(tmp_path):
    """One paper with few and short jobs."""
    return trimmed_paper(tmp_path)


@pytest.fixture(scope="session")
def built_once(tmp_path_factory, worker_id):
    """Built by the first worker of pytest that needs it, for all."""
    own = tmp_path_factory.getbasetemp()
    folder = (own if worker_id == "master" else own.parent) / "built"
    with (folder.parent / "built.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not folder.exists():
            project = trimmed_paper(tmp_path_factory.mktemp("building"))
            project.snakemake(*BUILT, *FEW)
            project.folder.rename(folder)
    return folder


@pytest.fixture
def built(built_once, tmp_path):
    """One paper with few and short jobs, of which those of a study have run."""
    return Project(tmp_path, built_once)
