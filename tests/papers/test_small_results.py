"""Claims, pages, figures and views of every paper on a few trials.

They run here for the first time, and not at the end of the long build. Two filters of a reader's
own run with the registered ones. They have only what a filter must have: init, step and mean.
"""

import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

import numpy as np
import pandas as pd
import pytest

from repro.filters import Filter
from repro.inspect.view import write_view
from repro.layout import Layout
from repro.pages.assumptions import write_assumptions
from repro.pages.consistency import write_summary
from repro.pages.leaderboard import write_leaderboard
from repro.pages.verdicts import write_diff
from repro.parameters.load import Paper, Point, load_paper, load_run
from repro.parameters.point_names import batch_of, is_common, on_request
from repro.parameters.readings import readings_of
from repro.plot import study_figures, style
from repro.plot.draw import draw
from repro.runner import FilteredPoint, run_filter
from repro.simulate import simulate
from repro.tables import bounds, consistency
from repro.tables.results import Results
from repro.tables.study_tables import tabulate
from repro.verdicts.claims import decide
from repro.verdicts.facts import state
from repro.verdicts.joint import compare_tables
from repro.verdicts.published import VERDICTS
from repro.verdicts.robustness import judge
from repro.workflow.code import constants
from tests.conftest import ROOT, catalogue

TRIALS = 3
MOST_STEPS = 500  # reached by the quadrotor alone, which flies the beginning of its path
RUN = load_run(ROOT / "params/run.yaml", {})
PAPERS = sorted(path.stem for path in (ROOT / "params").glob("*.yaml") if path.stem != "run")


EVERYWHERE, SOMEWHERE = "own_everywhere", "own_somewhere"


def own_filter(name: str) -> ModuleType:
    """The smallest filter there is: it stays where it began, a little off the mean."""
    module = ModuleType(f"repro.filters.{name}")
    module.LABEL, module.SEES = f"a reader's {name}", ("received",)
    offset = 0.01 if name == EVERYWHERE else 0.02

    def init_of(model):
        return lambda streams: np.tile(model.initial_mean, (len(streams), 1)) + offset

    def step(state, k, seen):
        assert len(seen.received) == len(state)
        return state

    module.build = lambda model, settings: Filter(init_of(model), step, mean=lambda state: state)
    return module


def with_own(points: dict[str, list[str]], families: dict[str, str]) -> dict[str, list[str]]:
    """The filters by point with both of the reader's own: one on every second point of a family."""
    seen: dict[str, int] = {}
    named = {}
    for point, filters in points.items():
        number = seen[families[point]] = seen.get(families[point], -1) + 1
        named[point] = [*filters, EVERYWHERE, *([SOMEWHERE] if number % 2 else [])]
    return named


SCRIPTS = [
    pytest.param(script, id=f"{script.parent.name}/{script.stem}")
    for script in sorted((ROOT / "figures").glob("*/*.py"))
    # Points of tables of their own do not run here: tests/unit/test_own_tables.py draws of those.
    if not {"on_request", "convergence", "mismatch"} & constants(str(script))["NEEDS"].keys()
]
OF_PAPER = ("claims", "facts", "joint", "robustness")
DIFF = {
    "csv": "diff.csv",
    "markdown": "diff.md",
    "html": "diff.html",
    "report": "diff.rst",
    "tally": "tally.txt",
} | {"robustness": "robustness.csv"}


class Small(NamedTuple):
    """A paper with the results of a few trials."""

    paper: Paper
    results: Results


Build = Callable[[str], Small]  # by the name of a paper


def once(build: Build) -> Build:
    """`build`, called once for each paper; its result, or its exception, is repeated."""
    outcomes: dict[str, Small | Exception] = {}

    def outcome(name: str) -> Small:
        if name not in outcomes:
            try:
                outcomes[name] = build(name)
            except Exception as error:
                outcomes[name] = error
        result = outcomes[name]
        if isinstance(result, Exception):
            raise result
        return result

    return outcome


@pytest.fixture(scope="session")
def small(tmp_path_factory: pytest.TempPathFactory) -> Build:
    """The small results of a paper: logs, runs, tables and curves."""

    @once
    def build(name: str) -> Small:
        paper = load_paper(ROOT / f"params/{name}.yaml")
        points = {
            study: with_own(
                {p: filters for p, filters in catalogue()[study].items() if is_common(p)},
                {p: at.family for p, at in of_study.items()},
            )
            for study, of_study in paper.studies.items()
        }
        own = (EVERYWHERE, SOMEWHERE)
        for filter_ in own:
            sys.modules[f"repro.filters.{filter_}"] = own_filter(filter_)
        folder = tmp_path_factory.mktemp(name)
        described = {study: paper.described(study) for study in paper.studies}
        results = Results(folder / "results", points, 1, described, own, RUN.tolerance)
        layout, claims, least = results.layout, [], []
        for study in points:
            run_study(results, study, paper.studies[study])
            table, curves = layout.table(study), layout.curves(study)
            files = [table, curves, *ranking_files(results, study)]
            first, second, *ranking = map(created, files)
            tabulate(results, study, first, second, ranking)
            claims += consistency.tabulate(results, study, created(layout.consistency(study)))
            least += bounds.tabulate(results, study, created(layout.bounds(study)))
        write_summary(claims, least, created(layout.consistency_summary(name)))
        compute(computed_tables(paper), results.layout, folder / "computed")
        return Small(paper, results)

    return build


def published_file(name: str) -> str:
    return str(ROOT / f"params/published/{name}.csv")


def computed_tables(paper: Paper) -> list[str]:
    """Tables of a paper that come from no trials: they have published values and no study."""
    studies = pd.read_csv(published_file(paper.name))["study"].dropna().unique()
    return [name for name in studies if name not in paper.studies]


def compute(tables: list[str], layout: Layout, folder: Path) -> None:
    """Make tables by their rules, in a folder of their own, for Snakemake takes no other's."""
    if not tables:
        return
    made = [Layout(folder / "results").table(table) for table in tables]
    command = [sys.executable, "-m", "snakemake", *made, "-j1", "--nolock"]
    subprocess.run(
        [*command, "--config", f"into={folder}"], cwd=ROOT, capture_output=True, check=True
    )
    for table, file in zip(tables, made, strict=True):
        shutil.copy(file, layout.table(table))


def run_study(results: Results, study: str, points: dict[str, Point]) -> None:
    """Simulate the points of a study and run its filters, as the jobs of the workflow do."""
    layout, filters = results.layout, results.catalogue[study]
    logs = {point: created(layout.log(study, point, 0)) for point in filters}
    for point, path in logs.items():
        parameters = points[point].parameters
        small = {"trials": TRIALS, "steps": min(parameters.steps, MOST_STEPS)}
        simulate(study, point, parameters.plain() | small, RUN.root_seed, (0, TRIALS), path)
    runs: dict[str, dict[str, list[str]]] = {}  # by filter and batch: its points
    for point, names in filters.items():
        for name in names:
            runs.setdefault(name, {}).setdefault(batch_of(point), []).append(point)
    for name, batches in runs.items():
        for batch, batched in batches.items():
            of_points = {
                point: FilteredPoint(
                    logs[point],
                    points[point].filters.get(name, {}),
                    consistency=point in results.consistency(study),
                )
                for point in batched
            }
            run_filter(study, name, of_points, created(layout.run(study, batch, name, 0)))


def ranking_files(results: Results, study: str) -> list[str]:
    """Where a study's ranking, its errors over k and their shares are."""
    layout = results.layout
    return [layout.ranking(study), layout.error_over_k(study), layout.error_shares(study)]


def created(path: str) -> str:
    """The path, with its folder created."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    return path


def plain(paper: Paper) -> dict[str, dict[str, dict]]:
    """Parameters, and settings by filter, of each point of each study, as JSON has them."""
    return {
        study: {
            point: {"parameters": values.parameters.plain(), "filters": values.filters}
            for point, values in points.items()
        }
        for study, points in paper.studies.items()
    }


@pytest.fixture(scope="session")
def judged(small: Build) -> Build:
    """Small results with claims and diff."""

    @once
    def judged_paper(name: str) -> Small:
        built = small(name)
        layout = built.results.layout
        published = published_file(name)
        decide(built.results, name, created(layout.claims(name)))
        state(built.results, name, created(layout.facts(name)))
        compare_tables(built.results, name, published, created(layout.joint(name)))
        readings = {study: readings_of(points) for study, points in plain(built.paper).items()}
        judge(built.results, name, readings, published, created(layout.robustness(name)))
        tables = [*built.paper.studies, *computed_tables(built.paper)]
        files = {
            "published": published,
            **{kind: getattr(layout, kind)(name) for kind in OF_PAPER},
            "tables": [layout.table(table) for table in tables],
        }
        pages = {key: layout.page(page) for key, page in DIFF.items()}
        write_diff({name: files}, RUN.tolerance, **pages)
        return built

    return judged_paper


@pytest.mark.parametrize("name", PAPERS)
def test_tables_have_every_filter_of_every_point(name, small):
    results = small(name).results
    for study, points in results.catalogue.items():
        table = results.table(study)
        tabulated = set(zip(table["point"], table["filter"], strict=True))
        assert tabulated == {(point, f) for point, filters in points.items() for f in filters}


@pytest.mark.parametrize("name", PAPERS)
def test_the_leaderboard_has_every_filter_and_knows_a_readers_own(name, small, tmp_path):
    built = small(name)
    rankings = {study: built.results.layout.ranking(study) for study in built.paper.studies}
    write_leaderboard(rankings, str(tmp_path / "board.csv"), str(tmp_path / "board.md"))
    board = pd.read_csv(tmp_path / "board.csv")
    assert set(board.loc[board["whose"] == "own", "filter"]) >= {EVERYWHERE}
    for study, points in built.results.catalogue.items():
        rows = board[board["study"] == study]
        ranked = set(zip(rows["point"], rows["filter"], strict=True))
        assert ranked == {(point, f) for point, filters in points.items() for f in filters}


@pytest.mark.parametrize("kind", ["over_k", "over_sweep", "distribution"])
@pytest.mark.parametrize("name", PAPERS)
def test_the_figures_that_every_study_has(name, kind, small):
    built = small(name)
    labels = set()
    for study in built.paper.studies:
        figure = getattr(study_figures, kind)(built.results, study)
        labels |= {text.get_text() for legend in figure.legends for text in legend.get_texts()}
        style.pyplot.close(figure)
    if kind != "over_sweep" or labels:  # a paper may have no sweep
        assert any(label.startswith(style.label(EVERYWHERE)) for label in labels)


@pytest.mark.parametrize("name", PAPERS)
def test_claims_are_decided_and_every_published_row_has_a_verdict(name, judged):
    results = judged(name).results
    assert set(results.claims(name)["verdict"]) <= set(VERDICTS["claim"])
    published = pd.read_csv(published_file(name))
    assert list(results.diff()["item"]) == list(published["item"])


@pytest.mark.parametrize("name", PAPERS)
def test_the_page_of_assumptions(name, judged):
    built = judged(name)
    layout = built.results.layout
    studies = plain(built.paper)
    files = {
        "parameters": str(ROOT / f"params/{name}.yaml"),
        "published": published_file(name),
        "studies": studies,
        "tables": {study: layout.table(study) for study in studies},
    }
    verdicts = (layout.page("diff.csv"), layout.page("robustness.csv"))
    write_assumptions({name: files}, RUN.tolerance, layout.page("assumptions.md"), *verdicts)
    page = Path(layout.page("assumptions.md")).read_text()
    assert f"## {name}" in page and "| study " in page
    readings = {reading for points in studies.values() for reading in readings_of(points)}
    readings = {reading for reading in readings if not on_request(reading)}
    assert readings
    assert all(f"| {reading.removeprefix('reading-')} " in page for reading in readings)


@pytest.mark.parametrize("script", SCRIPTS)
def test_every_figure_is_drawn(script, small, judged, monkeypatch, tmp_path):
    monkeypatch.chdir(ROOT)  # figures name the files of params/measured from there
    folder = script.parent.name
    needs = constants(str(script))["NEEDS"]
    needed = judged if needs.get("diff") else small
    built = needed(folder if folder in PAPERS else PAPERS[0])
    results = built.results
    if needs.get("leaderboard"):
        rankings = {study: results.layout.ranking(study) for study in built.paper.studies}
        write_leaderboard(rankings, results.layout.page("leaderboard.csv"), str(tmp_path / "b.md"))
    draw(script, results, tmp_path / "figure.png")
    assert (tmp_path / "figure.png").stat().st_size > 1000


@pytest.mark.parametrize("name", PAPERS)
def test_a_view_of_a_trial_of_every_study(name, small, tmp_path):
    results = small(name).results
    for study, points in results.catalogue.items():
        view, layout = tmp_path / f"{study}.mcap", tmp_path / f"{study}.json"
        point, filters = next(iter(points.items()))
        of_point = small(name).paper.studies[study][point].filters
        settings = {filter_: of_point.get(filter_, {}) for filter_ in filters}
        write_view(results.log(study, point), settings, TRIALS - 1, view, layout)
        assert view.stat().st_size > 1000 and layout.stat().st_size > 100
