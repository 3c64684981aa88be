"""A filter on logs recorded elsewhere."""

import json

import numpy as np
import pandas as pd
import pytest
from mcap.writer import Writer
from mcap_ros2.writer import Writer as Ros2Writer

from repro import plugins
from repro.errors import ReproError
from repro.inspect.user_log import run_user_log
from repro.logs import LogError, write_log
from repro.parameters.load import load_run, user_values
from repro.runner import run
from tests.conftest import ROOT, catalogue, points, registered, small_log

STUDY, POINT = "linear_delays", "arrival=0.5"


@pytest.fixture
def log():
    return small_log(STUDY, POINT, trials=1, steps=8)


@pytest.fixture
def user_log(log):
    settings = points()[STUDY][POINT].filters["omvf"]
    return {
        "study": STUDY,
        "point": POINT,
        "parameters": log.parameters.plain(),
        "settings": settings,
    }


def record(path, log, encoding, topics):
    """Record as another tool would: interleaved topics, other fields beside, no trial or step."""
    with path.open("wb") as stream:
        if encoding == "json":
            writer = Writer(stream)
            writer.start()
            channels = {t: writer.register_channel(t, "json", 0) for t in topics}
        else:
            writer = Ros2Writer(stream)
            schemas = {
                t: writer.register_msgdef(
                    f"robot_msgs/msg/T{i}",
                    "uint8 quality\n" + "".join(f"float64 {f}\n" for f in log.fields[t]),
                )
                for i, t in enumerate(topics)
            }
        for k in range(log.steps):
            for topic in topics:
                row = dict(zip(log.fields[topic], log.values[topic][0, k].tolist(), strict=True))
                row["quality"] = 1
                if encoding == "json":
                    data = json.dumps(row).encode()
                    writer.add_message(channels[topic], k * 1000, data, k * 1000)
                else:
                    writer.write_message(topic, schemas[topic], row, log_time=k * 1000)
        writer.finish()


@pytest.mark.parametrize("encoding", ["json", "cdr"])
def test_estimates_are_those_of_the_projects_own_log(encoding, log, user_log, tmp_path):
    record(tmp_path / "user.mcap", log, encoding, list(log.fields))
    run_user_log(tmp_path / "user.mcap", user_log, "omvf", tmp_path / "estimates.csv")
    table = pd.read_csv(tmp_path / "estimates.csv")
    estimate, runs = run(log, "omvf", user_log["settings"])
    np.testing.assert_allclose(table[["x1", "x2"]], estimate[0], rtol=1e-8)
    np.testing.assert_allclose(table[["error_x1", "error_x2"]], runs.error[0], rtol=1e-7, atol=1e-8)


def test_without_truth_there_are_estimates_and_no_errors(log, user_log, tmp_path):
    record(tmp_path / "user.mcap", log, "json", ["/received"])
    run_user_log(tmp_path / "user.mcap", user_log, "omvf", tmp_path / "estimates.csv")
    table = pd.read_csv(tmp_path / "estimates.csv")
    assert list(table.columns) == ["trial", "k", "x1", "x2"] and len(table) == log.steps


def test_what_a_log_lacks_is_named_with_the_channel_and_the_filter(log, user_log, tmp_path):
    path = tmp_path / "user.mcap"
    record(path, log, "json", ["/truth", "/received"])
    with pytest.raises(
        ReproError,
        match=r"topic /network: missing; .*; filter genie needs it for its channel 'delay'",
    ):
        run_user_log(path, user_log | {"settings": {}}, "genie", tmp_path / "estimates.csv")
    record(path, log._replace(fields=log.fields | {"/received": ("z", "u")}), "json", ["/received"])
    with pytest.raises(
        ReproError,
        match="topic /received: the field 'y' is missing; filter omvf needs it for its channel",
    ):
        run_user_log(path, user_log, "omvf", tmp_path / "estimates.csv")


@pytest.mark.parametrize("study", sorted(set(points()) - {"quadrotor"}))
def test_channels_are_made_of_the_fields_that_the_study_names(study):
    """Each channel stays the same if all but its own topics and fields are unknown."""
    log = small_log(study, next(iter(points()[study])), trials=2, steps=6)
    scenario = plugins.study(study)
    state = np.tile(scenario.model(log.parameters).initial_mean, (2, 1))
    made_of = scenario.channel_topics(log.parameters)

    def offered(log):
        channels = scenario.channels(log, slice(None))
        return [channels.at(k, state) for k in range(log.steps)]

    expected = offered(log)
    assert made_of.keys() == expected[0].keys()
    for channel, fields in made_of.items():
        known = {
            topic: np.where(np.isin(names, fields.get(topic, ())), log.values[topic], np.nan)
            for topic, names in log.fields.items()
        }
        if "/received" not in fields:
            known["/received"] = log.values["/received"]  # its shape may be used
        with np.errstate(invalid="ignore"):
            found = offered(log._replace(values=known))
        for k in range(log.steps):
            np.testing.assert_array_equal(found[k][channel], expected[k][channel])


def runs_alike(log, study, name, settings, tmp_path):
    """Write a log, run a filter on it as on a foreign one; compare with the pipeline's runs."""
    path = tmp_path / "0.mcap"
    write_log(path, log, period=1.0)
    _, runs = run(log, name, settings)
    given = {"study": study, "point": log.point, "settings": settings, "seed": 99}
    given["parameters"] = points()[study][log.point].parameters.plain()
    run_user_log(path, given, name, tmp_path / "estimates.csv")
    table = pd.read_csv(tmp_path / "estimates.csv")
    error = table[[f"error_{state}" for state in log.fields["/truth"]]].to_numpy()
    np.testing.assert_allclose(error.reshape(runs.error.shape), runs.error, rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize(
    ("study", "name", "settings"),
    [
        ("deadband", "mapf", {"particles": 20}),
        ("linear_losses", "rbpf_fast", {"particles": 20}),
        ("linear_delays", "intermittent_kf", {}),
        ("radar", "iekf", {}),
        ("rss_2d", "pf_ross_eh", {"particles": 20}),
        ("rss_2d", "spf_im", {"particles": 20}),
        ("ungm", "prior", {}),
        ("wsn_tracking", "emvf", {}),
        ("wsn_tracking", "emvf_realised", {}),
    ],
)
def test_a_log_of_the_pipeline_gives_its_own_estimates(study, name, settings, tmp_path):
    """The log's own root seed counts, also for particle filters."""
    log = small_log(study, next(iter(points()[study])), trials=2, steps=6, first=3)
    runs_alike(log, study, name, settings, tmp_path)


@pytest.mark.parametrize("study", sorted(set(points()) - {"quadrotor"}))
def test_a_filter_of_another_study_is_refused_in_one_line(study, tmp_path):
    log = small_log(study, next(iter(points()[study])), trials=1, steps=3)
    write_log(tmp_path / "0.mcap", log, period=1.0)
    given = {"study": study, "point": log.point, "settings": {}}
    given["parameters"] = log.parameters.plain()
    mine = {name for of_point in catalogue()[study].values() for name in of_point}
    for name in sorted({name for name, _, _ in registered()} - mine):
        try:
            run_user_log(tmp_path / "0.mcap", given, name, tmp_path / "estimates.csv")
        except ReproError as error:
            assert f"filter {name}" in str(error) and "\n" not in str(error)


def test_values_of_ones_own_replace_those_of_the_point(log, user_log, tmp_path):
    path, csv = tmp_path / "user.mcap", tmp_path / "estimates.csv"
    record(path, log, "json", ["/received"])

    def estimates(changes):
        run_user_log(path, user_log | {"changes": (changes, "noise.yaml")}, "omvf", csv)
        return pd.read_csv(csv)[["x1", "x2"]].to_numpy()

    start = estimates({"initial_estimate": [7.0, -2.0]})
    np.testing.assert_array_equal(start[0], [7.0, -2.0])
    louder = log.parameters.model_copy(update={"measurement_variance": 9.0})
    expected, _ = run(log._replace(parameters=louder), "omvf", user_log["settings"])
    np.testing.assert_allclose(estimates({"measurement_variance": 9.0}), expected[0], rtol=1e-8)
    for changes, fault in (
        ({"measurement_variance": -1}, "noise.yaml: measurement_variance: -1 is too small"),
        ({"noise": 1.0}, "noise.yaml: unknown key 'noise'; known keys are trials, steps"),
    ):
        with pytest.raises(ReproError, match=fault):
            estimates(changes)


def test_values_of_ones_own_come_from_config_or_a_file(tmp_path):
    file = tmp_path / "noise.yaml"
    file.write_text("steps: 5\n")
    assert user_values(str(file)) == ({"steps": 5}, str(file))
    assert user_values({"steps": 5}) == ({"steps": 5}, "--config: parameters")
    # Snakemake reads only the outermost value of --config.
    assert user_values({"steps": "5", "x": ["1.5", "a"]})[0] == {"steps": 5, "x": [1.5, "a"]}
    assert user_values(None)[0] == {}
    for given in (str(file), {"steps": 5}):
        assert load_run(ROOT / "params/run.yaml", {"parameters": given}).parameters == given


def test_a_log_of_the_pipeline_of_another_point_is_refused(log, user_log, tmp_path):
    path, csv = tmp_path / "0.mcap", tmp_path / "estimates.csv"
    write_log(path, log, period=1.0)
    with pytest.raises(LogError, match=r"is of point 'arrival=0\.5', expected is 'arrival=0\.6'"):
        run_user_log(path, user_log | {"point": "arrival=0.6"}, "omvf", csv)
    other = log.parameters.plain() | {"measurement_variance": 9.0}
    with pytest.raises(LogError, match="simulated with another measurement_variance"):
        run_user_log(path, user_log | {"parameters": other}, "omvf", csv)
    run_user_log(path, user_log | {"changes": ({"measurement_variance": 9.0}, "")}, "omvf", csv)


@pytest.mark.parametrize(
    ("study", "name", "topic", "field", "value", "fault"),
    [
        ("linear_losses", "iekf", "/network", "gamma", 7.3, "an integer from 0 to 1"),
        ("linear_delays", "genie", "/network", "delay", -1.5, "an integer from 0 to 2"),
        ("linear_delays", "genie", "/network", "delay", 3.0, "an integer from 0 to 2"),
        ("deadband", "mapf", "/received", "code_1_1", 9.0, "an integer from 0 to 3"),
        ("wsn_tracking", "emvf", "/received", "origin", 10.0**9, "an integer from -1 to"),
        ("wsn_tracking", "emvf", "/received", "origin", 5.0, "is 5; a packet is at most"),
        ("radar", "ekf", "/received", "range", np.nan, "is nan; it must be a finite number"),
        ("radar", "ekf", "/received", "bearing", np.inf, "is inf; it must be a finite number"),
    ],
)
def test_impossible_values_are_named(study, name, topic, field, value, fault, tmp_path):
    log = small_log(study, next(iter(points()[study])), trials=2, steps=6)
    values = log.values[topic].copy()
    values[1, 4, log.fields[topic].index(field)] = value
    write_log(tmp_path / "0.mcap", log._replace(values=log.values | {topic: values}), period=1.0)
    given = {"study": study, "point": log.point, "settings": {}}
    given["parameters"] = log.parameters.plain()
    with pytest.raises(
        ReproError, match=rf"topic {topic}: the field '{field}' of trial 1, step 4 .*{fault}"
    ) as error:
        run_user_log(tmp_path / "0.mcap", given, name, tmp_path / "estimates.csv")
    assert "\n" not in str(error.value)


def test_topics_of_unequal_length_and_too_many_steps_are_named(log, user_log, tmp_path):
    path = tmp_path / "user.mcap"
    short = log._replace(values=log.values | {"/truth": log.values["/truth"][:, :-1]})
    write_log(path, short, period=1.0)
    with pytest.raises(LogError, match="topic /truth: a trial has 8 messages, but 9 on /received"):
        run_user_log(path, user_log, "omvf", tmp_path / "estimates.csv")
    write_log(path, log, period=1.0)
    few = user_log["parameters"] | {"steps": 7}
    with pytest.raises(LogError, match=r"a trial has 9 messages; .* give steps=8 with --config"):
        run_user_log(path, user_log | {"parameters": few}, "omvf", tmp_path / "estimates.csv")
