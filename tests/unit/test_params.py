import copy
import itertools
import math
import subprocess
import sys

import pytest
import yaml

from repro.parameters.load import (
    ParameterError,
    check_shards,
    load_paper,
    load_run,
    sources,
    user_values,
    whose_logs,
)
from repro.parameters.readings import readings_of
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


POINT = ("studies", "linear_delays", "points", 0)
TRACKING = ("studies", "wsn_tracking")


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ((*LINEAR, "steps", "source"), None, "parameters.steps: 'source' is missing; add it"),
        ((*LINEAR, "trials", "why"), None, "parameters.trials: 'why' is missing; add it"),
        (
            (*LINEAR, "trials", "value"),
            0,
            "parameters.trials: 0 is too small; it must be at least 1",
        ),
        ((*LINEAR, "stepz"), {"value": 1, "source": "x"}, "unknown key 'stepz'; known keys are "),
        ((*POINT, "of"), ["x"], "'of' is for readings; begin the name with reading-"),
        ((*POINT, "names"), "x", "unknown key 'names'; known keys are source, why, name, sweep"),
        ((*LINEAR, "steps"), None, "parameters: 'steps' is missing; add it"),
        ((*LINEAR, "steps", "value"), "many", "parameters.steps: 'many' is not an integer"),
        ((*LINEAR, "steps", "value"), True, "parameters.steps: true is not an integer"),
        ((*LINEAR, "steps"), 300, "parameters.steps: 300 is not a mapping"),
        ((*LINEAR, "steps", "source"), "", "steps.source: is empty; it must have at least one"),
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
        ((*LINEAR, "measurement_row", "value"), [1.0], "has 1 entry; it must have 2"),
        ((*LINEAR, "measurement_row", "value"), [1.0] * 3, "has 3 entries; at most 2 allowed"),
        (
            (*TRACKING, "parameters", "sampling_time", "value"),
            "j",
            "sampling_time: 'j' is not a number or 'k'",
        ),
        ((*TRACKING, "analysis", "lost_above"), None, "analysis: 'lost_above' is missing; add it"),
        (
            (*POINT, "sweep", "arrival_probability"),
            [0.1, 1.2],
            "arrival=1.2: parameters.arrival_probability: 1.2 is too large; it must be at most 1",
        ),
        ((*POINT, "sweep", "arrival_probability"), [], "has 0 entries; at least 1 needed"),
        (
            (*POINT, "sweep", "emvf.x"),
            [1],
            "no settings of a filter 'emvf'; known are best_in_form, nahi,",
        ),
        ((*POINT, "sweep", "omvf.x"), [1], "filters.omvf: unknown key 'x'; known keys are alpha"),
        ((*POINT, "name"), "a={b}", "point name 'a={b}': there is no parameter or setting 'b'"),
        ((*POINT, "name"), "{omvf.b}", "there is no parameter or setting 'b'"),
        ((*POINT, "name"), "{", "point name '{': Single '{' encountered"),
        ((*POINT, "name"), "a b", "points.0.name: 'a b' has a wrong character; it must match"),
        ((*POINT, "name"), "same", "two points have this name"),
        ((*POINT, "name"), ".", "point name '.': it names a folder: at most 200 characters"),
        ((*POINT, "name"), "..", "point name '..': it names a folder"),
        ((*POINT, "name"), "a" * 201, "a': it names a folder"),
        ((*POINT, "name"), "a{{b", "point name 'a{b': it names a folder"),
        (
            (*POINT, "sweep"),
            {name: [1] * 100 for name in ("sine_period", "packet_bound", "steps")},
            "its sweep has 1000000 points; at most 10000 allowed",
        ),
        (
            ("studies", "linear_delays", "filters", "omvf", "alpha_rule", "value"),
            "8c",
            "filters.omvf.alpha_rule: '8c' is not 'sum to one' or '8b'",
        ),
        (
            ("studies", "no_study"),
            {"parameters": {}, "points": [{"name": "a", "source": "b"}]},
            "studies.no_study: study no_study: there is no src/repro/studies/no_study.py",
        ),
    ],
)
def test_an_error_is_one_line_that_names_file_and_key(path, value, message, tmp_path):
    file = changed(tmp_path, path, value)
    with pytest.raises(ParameterError) as error:
        load_paper(file)
    line = str(error.value)
    assert line.startswith(f"{file}: ") and message in line and "\n" not in line


@pytest.mark.parametrize("text", ["a: [1", "- 1", "", "\x00"])
def test_files_without_a_mapping(text, tmp_path):
    file = tmp_path / "x.yaml"
    file.write_text(text)
    with pytest.raises(ParameterError) as error:
        load_paper(file)
    assert "\n" not in str(error.value)


def laughs(first, again):
    """Aliases of aliases: each of seven lines stands for the one above, many times."""
    return first + "".join(
        again.format(name, above) for above, name in itertools.pairwise("abcdefgh")
    )


LISTS = laughs("a: &a [1]\n", "{0}: &{0} [" + "*{1}, " * 9 + "]\n")
MERGED = laughs("a: &a {x: 1}\n", "{0}: &{0} {{<<: [" + "*{1}, " * 9 + "]}}\n")


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (LISTS, "more than 100000 values, with each alias replaced"),
        (MERGED, "more than 100000 values, with each alias replaced"),
        ("a: &a [*a]\n", "contains itself; remove the alias"),
        ("a: " + "[" * 10**5, "more than 50 lists or mappings inside each other"),
        ("a: " + "[" * 60 + "]" * 60, "more than 50 lists or mappings inside each other"),
    ],
)
def test_a_file_that_would_take_all_memory_is_refused_at_once(text, fault, tmp_path):
    file = tmp_path / "x.yaml"
    file.write_text(text)
    for read in (load_paper, user_values):
        with pytest.raises(ParameterError) as error:
            read(str(file))
        assert str(error.value).startswith(f"{file}: {fault}")


def test_the_same_holds_for_values_given_on_the_spot():
    value = [1]
    for _ in range(9):
        value = [value] * 9
    with pytest.raises(ParameterError, match="--config: more than 100000 values"):
        load_run(ROOT / "params/run.yaml", {"parameters": {"a": value}})
    with pytest.raises(ParameterError, match="--config: parameters: more than 50 lists"):
        user_values({"a": "[" * 1000})


def test_an_alias_may_stand_for_a_value(tmp_path):
    (tmp_path / "x.yaml").write_text("a: &a {x: 1}\nb: *a\nc: {<<: *a, y: 2}\n")
    assert user_values(str(tmp_path / "x.yaml"))[0]["c"] == {"x": 1, "y": 2}


def test_what_a_terminal_would_obey_is_shown_escaped(tmp_path):
    (tmp_path / "x.yaml").write_text('"\\e[31mred": 1\n"\\e[31mred": 2\n')
    with pytest.raises(ParameterError) as error:
        load_paper(tmp_path / "x.yaml")
    assert "the key '\\x1b[31mred' appears a second time" in str(error.value)


def test_a_file_is_utf8_in_any_locale(tmp_path):
    (tmp_path / "x.yaml").write_text("a: ±\n", encoding="utf-8")
    code = "import sys, repro.parameters.load as l; print(ascii(l.user_values(sys.argv[1])))"
    words = [sys.executable, "-X", "warn_default_encoding", "-W", "error::EncodingWarning"]
    ran = subprocess.run(
        [*words, "-c", code, str(tmp_path / "x.yaml")], capture_output=True, text=True
    )
    assert "\\xb1" in ran.stdout, ran.stderr


@pytest.mark.parametrize("value", ["nan", math.nan, math.inf, "inf"])
def test_a_tolerance_is_a_finite_number(value):
    with pytest.raises(ParameterError, match=r"tolerance: .*is not a (finite )?number"):
        load_run(ROOT / "params/run.yaml", {"tolerance": value})


def test_overrides_of_the_run_are_checked():
    run = ROOT / "params" / "run.yaml"
    assert load_run(run, {"trials": 5}).trials == 5
    with pytest.raises(ParameterError, match=r"with --config: trials: 0 is too small"):
        load_run(run, {"trials": 0})
    with pytest.raises(ParameterError, match=r"unknown key 'trails'; known keys are root_seed"):
        load_run(run, {"trails": 5})


def test_points_are_resolved():
    studies = load_paper(PAPER).studies
    assert studies["linear_delays"]["arrival=1.0"].parameters.arrival_probability == 1.0
    point = studies["wsn_tracking"]["reading-as_printed@n2-arrival=0.9"]
    assert point.parameters.turn_rate_variance == 0.2
    assert point.filters["emvf"]["initial_second_moment"] == "P0"
    base = studies["wsn_tracking"]["n2-arrival=0.9"]
    assert base.filters["emvf"]["initial_second_moment"] == "theorem_2"


def test_points_that_are_simulated_alike_share_a_log():
    trials = 10  # those of a reading and of its base differ
    points = {
        n: p.with_trials(trials) for n, p in load_paper(PAPER).studies["linear_delays"].items()
    }
    of_sign, of_sine = "reading-qbar_sign=-1@arrival=0.5", "reading-sine_period=300@arrival=0.5"
    shared = whose_logs(points)
    assert shared[of_sign] == shared["arrival=0.5"] == "arrival=0.5"  # a setting of filters
    assert shared[of_sine] == of_sine  # a value of the simulation
    requested = {"sensitivity-a": points[of_sign], "arrival=0.5": points["arrival=0.5"]}
    assert set(whose_logs(requested).values()) == {"arrival=0.5"}


def test_a_sweep_reaches_the_settings_of_filters_and_joins_keys(tmp_path):
    family = {
        "name": "rule={omvf.alpha_rule}-bound={packet_bound}",
        "source": "x",
        "sweep": {"omvf.alpha_rule": ["sum to one", "8b"], "packet_bound, sine_period": [1, 3]},
        "set": {"arrival_probability": 0.5},
    }
    points = load_paper(changed(tmp_path, (*POINT[:-1], 1), family)).studies["linear_delays"]
    named = [name for name in points if name.startswith("rule=")]
    assert named == [f"rule={r}-bound={b}" for r in ("sum to one", "8b") for b in (1, 3)]
    assert points["rule=8b-bound=3"].filters["omvf"] == {"alpha_rule": "8b", "qbar_sign": 1}
    parameters = points["rule=8b-bound=3"].parameters
    assert (parameters.packet_bound, parameters.sine_period) == (3, 3)


READING = {
    "name": "reading-steps",
    "source": "x",
    "of": ["arrival=0.[57]", "nothing"],
    "set": {"steps": 7, "trials": 9},
    "filters": {"omvf": {"alpha_rule": "8b"}},
}


def test_a_reading_of_points_changes_each_of_them_and_nothing_else(tmp_path):
    paper = load_paper(changed(tmp_path, (*POINT[:3], 1), READING))
    points = paper.studies["linear_delays"]
    read = [name for name in points if name.startswith("reading-steps")]
    assert read == ["reading-steps@arrival=0.5", "reading-steps@arrival=0.7"]
    base, point = points["arrival=0.7"], points[read[1]]
    expected = base.parameters.plain() | {"steps": 7, "trials": 9}
    assert point.parameters.plain() == expected
    assert point.filters["omvf"] == base.filters["omvf"] | {"alpha_rule": "8b"}
    assert point.family != base.family and point.swept == base.swept
    plain = {
        n: {"parameters": p.parameters.plain(), "filters": p.filters} for n, p in points.items()
    }
    assert readings_of(plain)["reading-steps"] == {
        "points": {"arrival=0.5": read[0], "arrival=0.7": read[1]},
        "changes": {"steps": 7, "omvf.alpha_rule": "8b"},
    }


def test_a_reading_without_points_is_of_the_one_that_differs_least():
    def point(**parameters):
        return {"parameters": parameters, "filters": {}}

    points = {"far": point(a=1, b=1, trials=400), "near": point(a=2, b=1, trials=400)}
    points["reading-b=2"] = point(a=2, b=2, trials=100)
    found = {"points": {"near": "reading-b=2"}, "changes": {"b": 2}}
    assert readings_of(points) == {"reading-b=2": found}


def test_a_reading_of_no_point_is_refused(tmp_path):
    file = changed(tmp_path, (*POINT[:3], 1), READING | {"of": ["arrival=7"]})
    with pytest.raises(ParameterError, match=r"reading-steps: of: no point above matches arrival"):
        load_paper(file)


def test_thresholds_of_the_analysis_are_typed():
    assert load_paper(PAPER).analysis["wsn_tracking"]["lost_above"] == 10.0


def test_parameters_cannot_be_changed():
    point = load_paper(PAPER).studies["linear_delays"]["arrival=1.0"]
    with pytest.raises(ValueError, match="frozen"):
        point.parameters.steps = 1
    assert point.with_trials(7).parameters.trials == 7 and point.parameters.trials == 400


def test_every_point_has_a_trial_for_every_shard():
    studies = load_paper(PAPER).studies
    check_shards(studies, 200)
    with pytest.raises(ParameterError, match=r"shards: 201 are more than the 200 trials of lin"):
        check_shards(studies, 201)


def test_every_value_has_a_source_and_every_assumption_a_reason():
    for file in sorted((ROOT / "params").glob("*.yaml")):
        if file.name != "run.yaml":
            for row in sources(file):
                assert row["source"] and (row["source"] != "assumed" or row["why"])
