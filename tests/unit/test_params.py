import copy

import pytest
import yaml

from repro.parameters.load import ParameterError, load_paper, load_run, sources
from tests.conftest import ROOT

PAPER = ROOT / "params" / "packet_delays.yaml"
LINEAR = ("studies", "linear_delays", "parameters")


def changed(tmp_path, path, value):
    content = copy.deepcopy(yaml.safe_load(PAPER.read_text()))
    entry = content
    for key in path[:-1]:
        entry = entry[key]
    if value is None:
        del entry[path[-1]]
    else:
        entry[path[-1]] = value
    file = tmp_path / "packet_delays.yaml"
    file.write_text(yaml.safe_dump(content))
    return file


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        ((*LINEAR, "steps", "source"), None, "parameters.steps: 'source' is missing; add it"),
        ((*LINEAR, "trials", "why"), None, "parameters.trials: 'why' is missing; add it"),
        (
            (*LINEAR, "trials", "value"),
            0,
            "parameters.trials: 0 is too small; the least allowed is 1",
        ),
        (
            (*LINEAR, "stepz"),
            {"value": 1, "source": "x"},
            "unknown key 'stepz'; known are trials, ",
        ),
        ((*LINEAR, "steps"), None, "parameters: 'steps' is missing; add it"),
        ((*LINEAR, "steps", "value"), "many", "parameters.steps: 'many' is not of type integer"),
        (
            (*LINEAR, "initial_covariance", "value"),
            [[0.1, 0.2], [0.2, 0.1]],
            "initial_covariance: must be positive semidefinite; its smallest eigenvalue is -0.1",
        ),
        (
            (*LINEAR, "initial_covariance", "value"),
            [[0.1, 0.2], [0.0, 0.1]],
            "initial_covariance: must be a symmetric matrix",
        ),
        (
            ("studies", "linear_delays", "points", 0, "sweep", "arrival_probability"),
            [0.1, 1.2],
            "arrival=1.2: parameters.arrival_probability: 1.2 is too large; the most allowed",
        ),
        (
            ("studies", "linear_delays", "points", 0, "name"),
            "arrival={probability}",
            "point name 'arrival={probability}' names no parameter: 'probability'",
        ),
        (("studies", "linear_delays", "points", 0, "name"), "same", "two points have this name"),
        (
            ("studies", "linear_delays", "filters", "omvf", "alpha_rule", "value"),
            "8c",
            "filters.omvf.alpha_rule: '8c' is not one of sum to one, 8b",
        ),
        (
            ("studies", "no_study"),
            {"parameters": {}, "points": [{"name": "a", "source": "b"}]},
            "no such",
        ),
    ],
)
def test_a_fault_is_one_line_that_names_file_and_key(path, value, said, tmp_path):
    file = changed(tmp_path, path, value)
    with pytest.raises(ParameterError) as error:
        load_paper(file)
    message = str(error.value)
    assert message.startswith(f"{file}: ") and said in message and "\n" not in message


@pytest.mark.parametrize("text", ["a: [1", "- 1", "", "\x00"])
def test_files_that_are_no_mapping(text, tmp_path):
    file = tmp_path / "x.yaml"
    file.write_text(text)
    with pytest.raises(ParameterError) as error:
        load_paper(file)
    assert "\n" not in str(error.value)


def test_overrides_of_the_run_are_checked():
    run = ROOT / "params" / "run.yaml"
    assert load_run(run, {"trials": 5})["trials"] == 5
    with pytest.raises(ParameterError, match=r"with --config: trials: 0 is too small"):
        load_run(run, {"trials": 0})
    with pytest.raises(ParameterError, match=r"unknown key 'trails'; known are root_seed"):
        load_run(run, {"trails": 5})


def test_points_are_resolved():
    studies = load_paper(PAPER).studies
    assert studies["linear_delays"]["arrival=1.0"].parameters.arrival_probability == 1.0
    point = studies["wsn_tracking"]["as-printed-n2-arrival=0.9"]
    assert point.parameters.turn_rate_variance == 0.2
    assert point.filters["emvf"]["initial_second_moment"] == "P0"
    base = studies["wsn_tracking"]["n2-arrival=0.9"]
    assert base.filters["emvf"]["initial_second_moment"] == "theorem_2"


def test_every_value_has_a_source_and_every_assumption_a_reason():
    for file in sorted((ROOT / "params").glob("*.yaml")):
        if file.name != "run.yaml":
            for row in sources(file):
                assert row["source"] and (row["source"] != "assumed" or row["why"])
