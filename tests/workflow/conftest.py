"""A copy of the project with few points, in which Snakemake runs for real."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import yaml

from tests.conftest import ROOT

KEPT = ["Snakefile", "workflow", "src", "params", "profiles", "figures"]


class Project:
    """A folder with the project in it."""

    options = ("-j2",)
    environment = os.environ

    def __init__(self, folder: Path):
        self.folder = folder
        for name in KEPT:
            source = ROOT / name
            if source.is_dir():
                ignored = shutil.ignore_patterns("__pycache__", "*.png", "*.egg-info")
                shutil.copytree(source, folder / name, ignore=ignored)
            else:
                shutil.copy(source, folder / name)

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
            [sys.executable, "-m", "pytest", "-v", *arguments],
            cwd=self.folder,
            env={k: v for k, v in self.environment.items() if k != "PYTHONPATH"},
            capture_output=True,
            text=True,
        )
        assert run.returncode == 0, run.stdout + run.stderr
        return run.stdout

    def keep_only(self, paper: str, study: str, points: list[str]) -> None:
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
        for file in (self.folder / "params/published").glob("*.csv"):
            if file.stem == paper:
                head, *rows = file.read_text().splitlines(keepends=True)
                file.write_text(head + "".join(r for r in rows if r.startswith(beginnings)))
            else:
                file.unlink()
        module = self.folder / f"src/repro/papers/{paper}"
        for needs_all in ("facts.py", "tables.py"):
            (module / needs_all).unlink(missing_ok=True)
        claims = module / "claims/__init__.py"
        kept = f"CLAIMS[:] = [one for one in CLAIMS if one.item.startswith({beginnings})]\n"
        claims.write_text(f"{claims.read_text()}\n\n{kept}")

    def leave_only_own_studies(self) -> None:
        """Take out the papers: their parameters, published values, figures and rules."""
        for file in (self.folder / "params").glob("*.yaml"):
            if file.stem != "run":
                file.unlink()
        shutil.rmtree(self.folder / "params/published")
        shutil.rmtree(self.folder / "figures")
        filters = self.folder / "workflow/rules/filters.smk"
        rule = r"^use rule .*?(\n\n\n|\Z)"
        filters.write_text(re.sub(rule, "", filters.read_text(), flags=re.DOTALL | re.MULTILINE))
        snakefile = self.folder / "Snakefile"
        included = r'^include: "workflow/rules/papers/.*\n'
        snakefile.write_text(re.sub(included, "", snakefile.read_text(), flags=re.MULTILINE))

    @contextmanager
    def _families(self, paper: str, study: str) -> Iterator[list[dict]]:
        """The families of a study's points, to change them in the copy."""
        file = self.folder / "params" / f"{paper}.yaml"
        content = yaml.safe_load(file.read_text())
        yield content["studies"][study]["points"]
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


@pytest.fixture
def project(tmp_path):
    return Project(tmp_path)


@pytest.fixture
def trimmed(project):
    """The copy with two points of the linear study of packet delays: few and short jobs."""
    project.keep_only("packet_delays", "linear_delays", ["arrival=0.5", "arrival=0.9"])
    return project
