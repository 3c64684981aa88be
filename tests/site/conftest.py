"""A site of every paper from results that no run has made: each verdict is the expected one."""

import shutil
from importlib import import_module, util
from pathlib import Path

import pandas as pd
import pytest

from repro.layout import Layout
from repro.pages.site import build
from repro.parameters.load import load_paper, sources
from repro.tables.csv_file import write_csv
from repro.verdicts.published import DIFF_COLUMNS, read_published
from repro.verdicts.robustness import COLUMNS
from tests.conftest import ROOT, catalogue, registered

PAPERS = sorted(path.stem for path in (ROOT / "params/published").glob("*.csv"))
NEEDED_SOURCE = ("filters", "kernels", "studies")  # what pages show of the code
PICTURES = ("packet_delays/fig02", "packet_delays/table02", "studies/radar/over_k")
MISSING = [name for name in build.NEEDED if util.find_spec(name) is None]


def claims() -> dict[str, dict[str, str]]:
    """Statement of every claim, by paper and name."""
    modules = {paper: import_module(f"repro.papers.{paper}.claims") for paper in PAPERS}
    return {p: {c.item: c.statement for c in module.CLAIMS} for p, module in modules.items()}


def _verdicts(paper: str) -> list[dict]:
    """Rows of the diff as if all came out as expected, on the edge in turn, with every standing."""
    standings = ("robust (2 readings)", "reversed under a=1", "conditional on b=2", "")
    rows = []
    for i, row in enumerate(
        read_published(ROOT / f"params/published/{paper}.csv").to_dict("records")
    ):
        number = float(row["value"]) if row["kind"] == "value" else float("nan")
        known = {name: row[name] for name in row if name in DIFF_COLUMNS}
        known |= {"paper": paper, "verdict": row["expect"], "published": number, "ours": number}
        known |= {"mcse": 0.1, "z": 0.5, "margin": -3.5, "standing": standings[i % 4]}
        known |= {"statement": claims()[paper].get(row["item"], ""), "evidence": "1 comparisons"}
        rows.append(known | {"on_edge": i % 5 == 0, "as_expected": True, "seed_risk": 0.0})
    return rows


def write_results(root: Path) -> None:
    """The files that the site reads."""
    layout = Layout(root)
    verdicts = [row for paper in PAPERS for row in _verdicts(paper)]
    write_csv(pd.DataFrame(verdicts, columns=DIFF_COLUMNS), created(layout.page("diff.csv")))
    readings = [
        {"paper": row["paper"], "item": row["item"], "kind": row["kind"], "reading": "reading-a=1"}
        | {"changes": "a = 1", "points": "p", "verdict": row["verdict"], "margin": 1.0, "trials": 9}
        for row in verdicts
    ]
    write_csv(pd.DataFrame(readings, columns=COLUMNS), layout.page("robustness.csv"))
    for paper in PAPERS:
        parts = [
            {"paper": paper, "item": item, "statement": statement, "part": "p=0.5: ekf - bkf_1"}
            | {"difference": -1.0, "mcse": 0.1, "margin": -10.0, "verdict": "holds"}
            for item, statement in claims()[paper].items()
        ]
        write_csv(pd.DataFrame(parts), created(layout.claims(paper)))
        joint = ["paper", "table", "cells", "trials", "chi_square", "p_value", "farthest", "z"]
        write_csv(pd.DataFrame(columns=joint), created(layout.joint(paper)))
    files = [f for f in sorted((ROOT / "params").glob("*.yaml")) if f.name != "run.yaml"]
    write_csv([row for file in files for row in sources(file)], layout.page("parameters.csv"))
    family = {
        s: {p: at.family for p, at in of.items()}
        for f in files
        for s, of in load_paper(f).studies.items()
    }
    ranked = [
        {"study": study, "family": family[study][point], "point": point, "filter": name}
        | {"whose": "paper", "error": 1.0 + i, "mcse": 0.1, "median": 1.0, "lost": 0.0}
        | {"relative_to_informed": 1.0, "relative_to_nothing": 0.5, "verdict": "better"}
        for i, (name, study, point) in enumerate(registered())
    ]
    write_csv(pd.DataFrame(ranked), layout.page("leaderboard.csv"))
    times = pd.DataFrame(ranked)[["study", "family", "point", "filter"]]
    write_csv(times.assign(cpu_us_per_step=2.5), layout.page("leaderboard_times.csv"))


def created(path: str) -> str:
    """The path, with the folders above it."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    return path


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a built site: all papers, filters and studies, few figures, some code."""
    if MISSING:
        pytest.skip(f"{', '.join(MISSING)} missing: pip install -c constraints.txt -e '.[site]'")
    folder = tmp_path_factory.mktemp("site")
    project = folder / "project"
    for part in ("docs", "params", *(f"src/repro/{name}" for name in NEEDED_SOURCE)):
        shutil.copytree(ROOT / part, project / part, ignore=shutil.ignore_patterns("__pycache__"))
    for name in PICTURES:
        for ending in (".py", ".png"):
            file = ROOT / "figures" / f"{name}{ending}"
            if file.exists():
                shutil.copy(file, created(str(project / "figures" / f"{name}{ending}")))
    write_results(folder / "results")
    index = folder / "results/site/index.html"
    build.build_site(folder / "results", catalogue(), project, project / "figures", str(index))
    return index.parent
