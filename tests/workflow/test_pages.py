"""The examples of README and docs, run to the end of what these pages promise."""

import json
import re

import numpy as np
import pytest

from repro.statistics.runs import read_runs
from tests.conftest import ROOT
from tests.workflow.conftest import FEW, STUDY, STUDY_FIGURES, TABLE


def example(page: str, language: str = "python") -> list[str]:
    """The blocks of code that a page shows."""
    return re.findall(rf"```{language}\n(.*?)```", (ROOT / page).read_text(), re.DOTALL)


def add_filter(project, page: str, name: str) -> None:
    """Add the filter of a page and its rule, as the page says."""
    module, rule = example(page)
    (project.folder / f"src/repro/filters/{name}.py").write_text(module)
    with (project.folder / "workflow/rules/filters.smk").open("a") as rules:
        rules.write(f"\n\n{rule}")


def jobs_of(output: str) -> dict[str, int]:
    """Job counts of Snakemake's table of a dry run."""
    lines = output.split("Job stats:")[1].split("\n\n")[0].splitlines()[3:]
    return {name: int(count) for name, count in (line.split() for line in lines) if name != "total"}


def study_figures(study: str) -> list[str]:
    return [file.replace(STUDY, study) for file in STUDY_FIGURES]


def test_readmes_filter_in_table_figures_ranking_and_diff(built):
    """Only its own jobs and what depends on them run."""
    targets = [TABLE, "figures/packet_delays/fig01.png", *STUDY_FIGURES]
    before = built.bytes_of("figures/*/fig01.png", "figures/studies/*/*.png")
    add_filter(built, "README.md", "mine")
    planned = jobs_of(built.snakemake("-n", *targets, *FEW))
    drawn_anew = {"figures_linear_delays": 1, "study_figures": 1}
    assert planned == {"mine": 1, "table": 1} | drawn_anew
    built.snakemake(*targets, "results/diff.csv", *FEW)
    assert ",mine,rmse,x1," in (built.folder / TABLE).read_text()
    assert ",mine,own," in (built.folder / f"results/ranking/{STUDY}/table.csv").read_text()
    drawn = built.bytes_of("figures/*/fig01.png", "figures/studies/*/*.png")
    swept = f"figures/studies/{STUDY}/over_sweep.png"  # two points are no sweep
    assert {path for path in drawn if drawn[path] == before[path]} <= {swept}
    assert "Table 1: y(1)" in (built.folder / "results/diff.csv").read_text()


def test_readmes_filter_keeps_the_contract_and_is_ranked_at_once(paper):
    add_filter(paper, "README.md", "mine")
    assert "5 passed" in paper.pytest("tests/contract", "-k", "mine")
    options = ("filter=mine", f"study={STUDY}", "trials=20")
    output = paper.snakemake("leaderboard", "--config", *options)
    assert re.search(r"arrival=0\.5 +mine ", output)


@pytest.fixture
def losses(project):
    """The copy with two points of the studies of the worked example."""
    for study in ("linear_losses", "radar"):
        project.keep_families("unknown_losses", study, ["loss="])
        project.keep_values("unknown_losses", study, loss_probability=[0.3, 0.5])
    project.keep_filters("ekf", "iekf", "bkf_1", "rbpf_on_radar")
    return project


def test_the_worked_filter_in_tables_and_figures(losses):
    """docs/add-a-filter.md: in the linear study an unscented filter is the IKF."""
    add_filter(losses, "docs/add-a-filter.md", "ukf")
    studies = ("linear_losses", "radar")
    targets = [f"results/{kind}/{study}.csv" for kind in ("tables", "curves") for study in studies]
    targets += [file for study in studies for file in study_figures(study)]
    losses.snakemake(*targets, *FEW)
    losses.snakemake("draw", *FEW, "figure=unknown_losses/fig05a")
    assert (losses.folder / "figures/unknown_losses/fig05a.png").stat().st_size > 1000
    for target in targets:
        content = (losses.folder / target).read_bytes()
        assert content and (not target.endswith("csv") or b",ukf," in content)
    paths = (f"results/runs/linear_losses/main/{name}/0.npz" for name in ("ukf", "iekf"))
    ukf, ikf = (read_runs(losses.folder / path, "loss=0.3").error for path in paths)
    np.testing.assert_allclose(ukf, ikf, atol=1e-9)


def test_the_worked_filter_keeps_the_contract(losses):
    add_filter(losses, "docs/add-a-filter.md", "ukf")
    assert "10 passed" in losses.pytest("tests/contract", "-k", "ukf")


def test_the_worked_study(project):
    """docs/add-a-study.md, up to table, curves, figures, leaderboard, view and contract."""
    project.leave_only()
    project.keep_filters()
    (module,), (parameters,) = (example("docs/add-a-study.md", kind) for kind in ("python", "yaml"))
    (project.folder / "src/repro/studies/bearings.py").write_text(module)
    (project.folder / "params/bearings.yaml").write_text(parameters)
    view = "results/views/bearings/loss_after_arrival=0.2/trial-3"
    targets = ["results/tables/bearings.csv", "results/curves/bearings.csv"]
    targets += [*study_figures("bearings"), "results/leaderboard.md", f"{view}.mcap"]
    project.snakemake(*targets, *FEW)
    assert all((project.folder / target).stat().st_size > 0 for target in targets)
    board = (project.folder / "results/leaderboard.md").read_text()
    assert "## bearings" in board and "RBPF" in board
    assert json.loads((project.folder / f"{view}.layout.json").read_text())
    assert "30 passed" in project.pytest("tests/contract", "-k", "bearings")


SLIP = """
import numpy as np
from repro.filters import Filter

LABEL = "mine"
SEES = ("received",)


def corrected(state):
    return state @ np.ones(3)  # the slip


def build(model, settings):
    def step(state, k, seen):
        return corrected(state)

    return Filter(
        init=lambda streams: np.zeros((len(streams), 2)), step=step, mean=lambda state: state
    )
"""


def test_an_exception_in_a_filter_shows_its_own_lines_alone(built):
    add_filter(built, "README.md", "mine")
    (built.folder / "src/repro/filters/mine.py").write_text(SLIP)
    target = "results/runs/linear_delays/main/mine/0.npz"
    output = built.snakemake(target, *FEW, fails=True)
    assert "return state @ np.ones(3)  # the slip" in output
    assert "return corrected(state)" in output
    frames = re.findall(r'File "(.*?)", line', output)
    assert frames and all(frame.endswith("repro/filters/mine.py") for frame in frames)
    (line,) = (line for line in output.splitlines() if line.strip().startswith("error: "))
    where = "filter mine on linear_delays, arrival=0.5: step(state, k, seen) at step 1"
    assert f"{where}, trials 0 to 3: ValueError: " in line
    assert "Traceback" not in output


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("dict(gain=0.1)", "dict(gian=0.1)", "the setting 'gain' is missing; give it in its rule"),
        ("dict(gain=0.1)", "dict(gain=0.1, gian=1)", "the setting 'gian' is never used; fix the"),
    ],
)
def test_wrong_settings_end_a_job_in_one_line(built, old, new, message):
    add_filter(built, "README.md", "mine")
    edit(built, "workflow/rules/filters.smk", old, new)
    target = "results/runs/linear_delays/main/mine/0.npz"
    output = built.snakemake(target, *FEW, fails=True)
    (line,) = (line for line in output.splitlines() if line.strip().startswith("error: "))
    assert f"filter mine on linear_delays, arrival=0.5: {message}" in line
    assert "Traceback" not in output


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('runs("mine"', 'runs("omvf"', "filter omvf: two rules run it on linear_delays"),
        ('runs("mine"', 'runs("nime"', "filter nime: there is no "),
        ("settings=dict(gain=0.1)", 'name="mine"', "rule mine: params: 'name' has no meaning"),
        (
            "settings=dict(gain=0.1)",
            'code=code("repro.runner", "repro.filters.omvf")',
            "rule mine: params: code must reach repro.filters.{filter}; leave out code",
        ),
        (
            "settings=dict(gain=0.1)",
            'code=code("repro.runer", "repro.filters.{filter}")',
            "code(): there is no module repro.runer in src/",
        ),
    ],
)
def test_a_wrong_rule_ends_in_one_line_before_any_job(paper, old, new, message):
    add_filter(paper, "README.md", "mine")
    edit(paper, "workflow/rules/filters.smk", old, new)
    output = paper.snakemake("-n", TABLE, fails=True)
    (line,) = (line for line in output.splitlines() if line.startswith("error: "))
    assert message in line and "Traceback" not in output


def edit(project, path: str, old: str, new: str) -> None:
    file = project.folder / path
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
