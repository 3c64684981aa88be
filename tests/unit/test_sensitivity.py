"""The sensitivity table of censored_network, from runs whose order is known."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from repro.layout import Layout
from repro.papers.censored_network import sensitivity
from repro.parameters.load import load_paper
from repro.parameters.point_names import batch_of
from repro.statistics import metrics
from repro.statistics.runs import Runs, RunsWriter
from repro.statistics.shards import Columns
from repro.tables.results import Results
from tests.conftest import ROOT

SCALE = {"mapf": 1.0, "mpf": 1.0, "mapf_nc": 2.0, "mapf_nmc": 1.5, "dead_reckoning": 3.0}
TRIALS = {"base": 60, "reading-speed=2": 40, "sensitivity-particles=9": 40}


@pytest.fixture
def results(tmp_path):
    rng = np.random.default_rng(0)
    for point, trials in TRIALS.items():
        for filter_, scale in SCALE.items():
            file = Path(Layout(tmp_path).run("deadband", batch_of(point), filter_, 0))
            file.parent.mkdir(parents=True)
            error = scale * rng.standard_normal((trials, 61, 9))
            with file.open("wb") as stream, RunsWriter(stream) as writer:
                writer.add(point, Runs(error, None, np.zeros(trials), recorded={}))
    catalogue = {"deadband": {point: [*SCALE] for point in TRIALS}}
    paper = load_paper(ROOT / "params/censored_network.yaml")
    studies = {"deadband": paper.described("deadband")}
    return Results(tmp_path, catalogue, 1, studies, [], tolerance=3.0)


def test_orders_are_decided_on_paired_runs(results, tmp_path):
    sensitivity.tabulate(results, "deadband", tmp_path / "table.csv")
    table = pd.read_csv(tmp_path / "table.csv")
    assert {"base", "speed=2", "particles=9", "from k = 0"} <= set(table["reading"])
    orders = table[(table["metric"] == "order") & (table["reading"] == "speed=2")]
    verdicts = dict(zip(orders["filter"], orders["verdict"], strict=True))
    assert verdicts == {
        "mapf < mapf_nc": "holds",
        "mapf_nc < mapf_nmc": "fails",
        "mapf < mpf": "undecided",
        "mapf < dead_reckoning": "holds",
    }
    levels = table[table["metric"] == "rmse"].set_index(["reading", "filter"])
    assert levels.loc[("speed=2", "mapf_nc"), "value"] == pytest.approx(2 * np.sqrt(2), rel=0.02)
    of_base = levels.xs("mapf", level="filter")["trials"]
    assert (of_base["base"], of_base["base, as few runs"]) == (60, 40)


def mean_of_roots(squared):
    """Of the targets, and their mean: (..., steps, targets) to (..., targets + 1)."""
    of_targets = np.sqrt(squared).mean(axis=-2)
    return np.concatenate([of_targets, of_targets.mean(axis=-1, keepdims=True)], axis=-1)


def test_the_tables_statistic_is_that_of_claims_and_covers_the_spread():
    """Target by target and step by step, or in one array: the numbers are the same."""
    squared = np.random.default_rng(1).chisquare(2, (200, 30, 3))
    targets = [Columns(iter([squared[:, :, i]]), [200]) for i in range(3)]
    of_targets = [metrics.roots_over_steps(target) for target in targets]
    numbers = [*of_targets, metrics.average(of_targets)]
    left_out = metrics.leave_one_out(squared, mean_of_roots)
    np.testing.assert_allclose(np.transpose([n.left_out for n in numbers]), left_out, rtol=1e-12)
    value = mean_of_roots(squared.mean(axis=0))
    np.testing.assert_allclose([n.value for n in numbers], value, rtol=1e-12)
    repeated = np.random.default_rng(2).chisquare(2, (300, 200, 30, 3))
    spread = mean_of_roots(repeated.mean(axis=1)).std(axis=0)
    errors = [metrics.statistic(number).mcse for number in numbers]
    np.testing.assert_allclose(errors, spread, rtol=0.2)
