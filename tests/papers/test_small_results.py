"""Claims, pages, figures and views of every paper on a few trials.

They run here for the first time, and not at the end of the long build. Two filters of a reader's
own run with the registered ones. They have only what a filter must have: init, step and mean.
"""

import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

import numpy as np
import pandas as pd
import pytest

from repro import plugins
from repro.filters import Filter
from repro.inspect.view import write_view
from repro.pages.assumptions import write_assumptions
from repro.pages.leaderboard import write_leaderboard
from repro.pages.verdicts import write_diff
from repro.papers.packet_delays import packet_example
from repro.papers.unknown_losses import operation_counts
from repro.parameters.load import Paper, load_paper, load_run, on_request
from repro.plot import study_figures, style
from repro.plot.draw import draw
from repro.runner import run_filter
from repro.simulate import simulate
from repro.studies import ClosedLoop
from repro.tables.csv_file import write_csv
from repro.tables.ranking import tabulate_ranking
from repro.tables.results import Results
from repro.tables.study_tables import tabulate
from repro.verdicts.claims import decide
from repro.verdicts.published import VERDICTS
from repro.workflow.code import constants
from tests.conftest import ROOT, catalogue

TRIALS = 3
MOST_STEPS = 800  # reached by the quadrotor alone, which flies the beginning of its path
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


def scripts(diff: bool) -> list:
    """Figures that are not drawn on request, with their paper; the overview with the first."""
    chosen = []
    for script in sorted((ROOT / "figures").glob("*/*.py")):
        needs, folder = constants(str(script))["NEEDS"], script.parent.name
        if not needs.get("on_request") and needs.get("diff", False) == diff:
            paper = folder if folder in PAPERS else PAPERS[0]
            chosen.append(pytest.param(paper, script, id=f"{paper}-{folder}/{script.stem}"))
    return chosen


class Small(NamedTuple):
    """A paper with the results of a few trials."""

    paper: Paper
    results: Results

    def published(self) -> str:
        return str(ROOT / f"params/published/{self.paper.name}.csv")


def packet_table(paper: Paper, path: str) -> None:
    packet_example.tabulate("table_1", paper.examples["table_1"], path)


def operations_table(paper: Paper, path: str) -> None:
    particles = paper.studies["radar"]["loss=0.5"].filters["rbpf"]["particles"]
    write_csv(operation_counts.table_1(6, 2, particles), path)


# Tables that come from no trials, as the rules of the papers make them.
COMPUTED: dict[str, dict[str, Callable[[Paper, str], None]]] = {
    "packet_delays": {"packet_example": packet_table},
    "unknown_losses": {"complexity": operations_table},
}


@pytest.fixture(scope="session", params=PAPERS)
def small(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Small:
    """The small results of a paper: logs, runs, tables and curves."""
    name = request.param
    paper = load_paper(ROOT / f"params/{name}.yaml")
    points = {
        study: with_own(
            {p: filters for p, filters in catalogue()[study].items() if not on_request(p)},
            {p: at.family for p, at in of_study.items()},
        )
        for study, of_study in paper.studies.items()
    }
    own = (EVERYWHERE, SOMEWHERE)
    for filter_ in own:
        sys.modules[f"repro.filters.{filter_}"] = own_filter(filter_)
    described = {study: paper.described(study) for study in paper.studies}
    results = Results(tmp_path_factory.mktemp(name), points, 1, described, own, RUN.tolerance)
    for study, of_study in points.items():
        for point, filters in of_study.items():
            run_point(results, paper, study, point, filters)
        table, curves = results.layout.table(study), results.layout.curves(study)
        tabulate(results, study, created(table), created(curves))
        tabulate_ranking(results, study, *map(created, ranking_files(results, study)))
    for table, make in COMPUTED.get(name, {}).items():
        make(paper, results.layout.table(table))
    return Small(paper, results)


def run_point(results: Results, paper: Paper, study: str, point: str, filters: list[str]) -> None:
    """Simulate a point and run its filters, as the jobs of the workflow do."""
    layout, (parameters, settings, *_) = results.layout, paper.studies[study][point]
    small = {"trials": TRIALS, "steps": min(parameters.steps, MOST_STEPS)}
    log = created(layout.log(study, point, 0))
    simulate(study, point, parameters.plain() | small, RUN.root_seed, (0, TRIALS), log)
    for filter_ in filters:
        path, flight = (of(study, point, filter_, 0) for of in (layout.run, layout.flight))
        closed_loop = isinstance(plugins.study(study), ClosedLoop)
        run_filter(
            log,
            study,
            point,
            filter_,
            settings.get(filter_, {}),
            created(path),
            created(flight) if closed_loop else None,
        )


def ranking_files(results: Results, study: str) -> list[str]:
    """Where a study's ranking, its errors over k and their shares are."""
    layout = results.layout
    return [layout.ranking(study), layout.error_over_k(study), layout.error_shares(study)]


def created(path: str) -> str:
    """The path, with its folder created."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    return path


@pytest.fixture(scope="session")
def judged(small: Small) -> Small:
    """Small results with claims and diff."""
    name, layout = small.paper.name, small.results.layout
    decide(small.results, name, created(layout.claims(name)))
    tables = [*small.paper.studies, *COMPUTED.get(name, {})]
    files = {
        "published": small.published(),
        "claims": layout.claims(name),
        "tables": [layout.table(table) for table in tables],
    }
    pages = {"csv": "diff.csv", "markdown": "diff.md", "report": "diff.rst", "tally": "tally.txt"}
    write_diff(
        {name: files}, RUN.tolerance, **{key: layout.page(page) for key, page in pages.items()}
    )
    return small


def test_tables_have_every_filter_of_every_point(small):
    for study, points in small.results.catalogue.items():
        table = small.results.table(study)
        tabulated = set(zip(table["point"], table["filter"], strict=True))
        assert tabulated == {(point, f) for point, filters in points.items() for f in filters}


def test_the_leaderboard_has_every_filter_and_knows_a_readers_own(small, tmp_path):
    layout = small.results.layout
    rankings = {study: layout.ranking(study) for study in small.paper.studies}
    write_leaderboard(rankings, tmp_path / "board.csv", tmp_path / "board.md")
    board, page = pd.read_csv(tmp_path / "board.csv"), (tmp_path / "board.md").read_text()
    assert set(board.loc[board["whose"] == "own", "filter"]) >= {EVERYWHERE}
    for study, points in small.results.catalogue.items():
        rows = board[board["study"] == study]
        ranked = set(zip(rows["point"], rows["filter"], strict=True))
        assert ranked == {(point, f) for point, filters in points.items() for f in filters}
        assert plugins.filter_module(EVERYWHERE).LABEL in page


@pytest.mark.parametrize("kind", ["over_k", "over_sweep", "distribution"])
def test_the_figures_that_every_study_has(small, kind):
    labels = set()
    for study in small.paper.studies:
        figure = getattr(study_figures, kind)(small.results, study)
        labels |= {text.get_text() for legend in figure.legends for text in legend.get_texts()}
    if kind != "over_sweep" or labels:  # a paper may have no sweep
        assert style.label(EVERYWHERE) in labels


def test_claims_are_decided_and_every_published_row_has_a_verdict(judged):
    assert set(judged.results.claims(judged.paper.name)["verdict"]) <= set(VERDICTS["claim"])
    published = pd.read_csv(judged.published())
    assert list(judged.results.diff()["item"]) == list(published["item"])


def test_the_page_of_assumptions(small):
    name, layout = small.paper.name, small.results.layout
    studies = {
        study: {
            point: {"parameters": values.parameters.plain(), "filters": values.filters}
            for point, values in points.items()
        }
        for study, points in small.paper.studies.items()
    }
    files = {
        "parameters": str(ROOT / f"params/{name}.yaml"),
        "published": small.published(),
        "studies": studies,
        "tables": {study: layout.table(study) for study in studies},
    }
    write_assumptions({name: files}, RUN.tolerance, layout.page("assumptions.md"))
    page = Path(layout.page("assumptions.md")).read_text()
    assert f"## {name}" in page and "| study " in page


@pytest.mark.parametrize(("small", "script"), scripts(diff=False), indirect=["small"])
def test_every_figure_is_drawn(small, script, monkeypatch, tmp_path):
    draw_here(script, small.results, monkeypatch, tmp_path)


@pytest.mark.parametrize(("small", "script"), scripts(diff=True), indirect=["small"])
def test_every_figure_of_the_verdicts_is_drawn(judged, script, monkeypatch, tmp_path):
    draw_here(script, judged.results, monkeypatch, tmp_path)


def draw_here(script, results, monkeypatch, tmp_path):
    monkeypatch.chdir(ROOT)  # figures name the files of params/measured from there
    draw(script, results, tmp_path / "figure.png")
    assert (tmp_path / "figure.png").stat().st_size > 1000


def test_a_view_of_a_trial_of_every_study(small, tmp_path):
    for study, points in small.results.catalogue.items():
        view, layout = tmp_path / f"{study}.mcap", tmp_path / f"{study}.json"
        write_view(small.results, study, next(iter(points)), TRIALS - 1, view, layout)
        assert view.stat().st_size > 1000 and layout.stat().st_size > 100
