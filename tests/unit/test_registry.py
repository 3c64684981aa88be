"""The registry of filters, which their rules fill."""

import json
from types import SimpleNamespace
from typing import Any, NamedTuple

import pytest

from repro.errors import ReproError
from repro.layout import Layout
from repro.workflow.registry import FILTER_MODULE, Registry, matching_points, write_catalogue

POINTS = {"radar": ["loss=0.1", "loss=0.5", "markov"], "quadrotor": ["nominal"]}


@pytest.fixture
def registry():
    return Registry(Layout("results"), POINTS, shards=2)


def test_patterns_of_points():
    points = POINTS["radar"]
    assert matching_points(points) == points
    assert matching_points(points, "loss=*") == points[:2]
    assert matching_points(points, ["markov", "loss=0.1"]) == ["loss=0.1", "markov"]
    assert matching_points(points, skipped=["loss=*"]) == ["markov"]


def test_a_rules_output_matches_its_filter_and_studies_alone(registry):
    output = registry.runs("ekf", ["radar", "quadrotor"])
    assert output == "results/runs/{study,radar|quadrotor}/{batch}/{filter,ekf}/{shard}.npz"


def test_filters_are_listed_in_the_order_of_their_rules(registry):
    registry.runs("iekf", ["radar"], points="loss=*")
    registry.runs("ekf", ["radar"], skip=["loss=0.5"])
    assert registry.catalogue("radar", "quadrotor") == {
        "radar": {"loss=0.1": ["iekf", "ekf"], "loss=0.5": ["iekf"], "markov": ["ekf"]},
        "quadrotor": {},
    }


def test_files_of_every_filter_and_shard(registry):
    registry.runs("ekf", ["radar"], points="loss=*")
    registry.runs("iekf", ["radar"], points="loss=0.5")
    assert registry.run_files("radar", ["loss=0.5"]) == [
        f"results/runs/radar/main/{name}/{shard}.npz"
        for name in ("ekf", "iekf")
        for shard in (0, 1)
    ]
    assert registry.run_files("radar", ["loss=0.1"]) == [
        f"results/runs/radar/main/ekf/{shard}.npz" for shard in (0, 1)
    ]
    assert registry.log_files("radar") == [
        f"results/logs/radar/{point}/{shard}.mcap"
        for point in ("loss=0.1", "loss=0.5")
        for shard in (0, 1)
    ]


def test_readings_and_points_on_request_are_batches_of_their_own():
    points = ["base", "reading-turn=1", "far-reading-turn=1", "sensitivity-noise"]
    registry = Registry(Layout("results"), {"deadband": points}, 1, {"deadband": {"base"}})
    registry.runs("mapf", ["deadband"], points=["base", "*turn*"])
    assert list(registry.batches()) == [
        ("deadband", "readings", points[1:3]),
        ("deadband", "requested", points[3:]),
    ]
    assert registry.in_batch("mapf", "deadband", "readings") == points[1:3]
    assert registry.in_batch("mapf", "deadband", "main") == []


def test_points_of_one_log():
    shared = {"radar": {"loss=0.5": "loss=0.1"}}
    registry = Registry(Layout("results"), POINTS, shards=1, log_of=shared)
    registry.runs("ekf", ["radar"])
    files = [f"results/logs/radar/{point}/0.mcap" for point in ("loss=0.1", "markov")]
    assert registry.log_files("radar") == files
    assert registry.log_files("radar", ["loss=0.5"]) == files[:1]
    assert next(registry.batches()) == ("radar", "main", ["loss=0.1", "markov"])


def test_points_on_request_are_left_out_unless_requested():
    registry = Registry(Layout("results"), {"deadband": ["base", "sensitivity-noise"]}, shards=1)
    registry.runs("mapf", ["deadband"])
    assert list(registry.catalogue("deadband")["deadband"]) == ["base"]
    assert len(registry.run_files("deadband")) == 1
    assert len(registry.run_files("deadband", requested=True)) == 2


def test_an_unknown_study_or_point_is_refused_in_one_line(registry):
    with pytest.raises(ReproError, match=r"filter ekf: there is no study 'rader'; the studies are"):
        registry.runs("ekf", ["rader"])
    with pytest.raises(ReproError, match=r"filter ekf: no point of radar matches los=\*"):
        registry.runs("ekf", ["radar"], points="los=*")


def test_the_catalogue_is_written_as_json(registry, tmp_path):
    filters, settings = {"radar": {"markov": ["ekf"]}}, {"radar": {"markov": {"ekf": {"a": 1}}}}
    write_catalogue(filters, settings, tmp_path / "catalogue.json")
    written = json.loads((tmp_path / "catalogue.json").read_text())
    assert written == {"filters": filters, "settings": settings}


class Rule(NamedTuple):
    """What the registry reads of a rule of Snakemake."""

    name: str
    output: list[str]
    params: dict[str, Any]


def reaches(*modules: str) -> SimpleNamespace:
    """What code(...) gives a rule."""
    return SimpleNamespace(modules=modules)


def copied(registry: Registry, name: str, **params: Any) -> Rule:
    output = [registry.runs(name, ["quadrotor"])]
    return Rule("copied", output, {"code": reaches(FILTER_MODULE)} | params)


def test_settings_of_a_rule_come_before_those_of_params():
    point = SimpleNamespace(filters={"ekf": {"a": 1}, "iekf": {"a": 2}})
    registry = Registry(Layout("results"), {"quadrotor": {"nominal": point}}, shards=1)
    registry.read_settings([copied(registry, "ekf", settings={"a": 3}), copied(registry, "iekf")])
    assert registry.all_settings("quadrotor") == {
        "quadrotor": {"nominal": {"ekf": {"a": 3}, "iekf": {"a": 2}}}
    }


@pytest.mark.parametrize(
    ("params", "message"),
    [
        ({"filter_": "iekf"}, "params: 'filter_' has no meaning"),
        ({"points": {"nominal": {}}}, "params: 'points' has no meaning"),
        ({"settings": 0.1}, "settings is a float; write settings=dict"),
        ({"code": reaches("repro.filters.iekf")}, "leave out code"),
    ],
)
def test_a_rule_names_no_other_filter_than_its_output(registry, params, message):
    with pytest.raises(ReproError, match=f"rule copied: .*{message}"):
        registry.read_settings([copied(registry, "ekf", **params)])


def test_a_copied_rule_with_the_old_name_is_refused(registry):
    registry.runs("ekf", ["radar"], points="loss=*")
    with pytest.raises(ReproError, match=r"filter ekf: two rules run it on radar; fix"):
        registry.runs("ekf", ["radar"], skip="loss=0.1")
