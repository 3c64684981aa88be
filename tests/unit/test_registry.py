"""The registry of filters, which their rules fill."""

import json

import pytest

from repro.errors import ReproError
from repro.layout import Layout
from repro.workflow.registry import Registry, matching_points, write_catalogue

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
    assert output == "results/runs/{study,radar|quadrotor}/{point}/{filter,ekf}/{shard}.npz"


def test_filters_are_listed_in_the_order_of_their_rules(registry):
    registry.runs("iekf", ["radar"], points="loss=*")
    registry.runs("ekf", ["radar"], skip=["loss=0.5"])
    assert registry.catalogue("radar", "quadrotor") == {
        "radar": {"loss=0.1": ["iekf", "ekf"], "loss=0.5": ["iekf"], "markov": ["ekf"]},
        "quadrotor": {},
    }


def test_files_of_every_filter_and_shard(registry):
    registry.runs("ekf", ["radar"], points="loss=*")
    assert registry.run_files("radar", ["loss=0.5"]) == [
        f"results/runs/radar/loss=0.5/ekf/{shard}.npz" for shard in (0, 1)
    ]
    assert len(registry.run_files("radar")) == 4
    assert registry.log_files("radar") == [
        f"results/logs/radar/{point}/{shard}.mcap"
        for point in ("loss=0.1", "loss=0.5")
        for shard in (0, 1)
    ]


def test_only_a_closed_loop_has_flights(registry):
    registry.runs("ekf", ["radar", "quadrotor"])
    output = registry.flights("ekf", ["quadrotor"])
    assert output == "results/flights/{study,quadrotor}/{point}/{filter,ekf}/{shard}.mcap"
    assert registry.flight_files("radar", "markov") == []
    assert registry.flight_files("quadrotor", "nominal") == [
        f"results/flights/quadrotor/nominal/ekf/{shard}.mcap" for shard in (0, 1)
    ]


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
    registry.runs("ekf", ["radar"])
    catalogue = registry.catalogue("radar")
    write_catalogue(catalogue, tmp_path / "catalogue.json")
    assert json.loads((tmp_path / "catalogue.json").read_text()) == catalogue
