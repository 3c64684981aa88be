"""Parameters, settings and logs of any content: an error in one line, never a traceback."""

import copy
import json
import math

import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from mcap.writer import Writer

from repro.errors import ReproError
from repro.logs import read_log, write_log
from repro.logs.user_log import read_user_log
from repro.parameters.load import load_paper, load_run
from repro.parameters.settings import checked_settings
from repro.parameters.yaml_file import read_yaml
from repro.runner import FilteredPoint, run_filter
from repro.simulate import simulate
from tests.conftest import ROOT, SEED, points, registered, small_log

PAPERS = {
    path.stem: path for path in sorted((ROOT / "params").glob("*.yaml")) if path.stem != "run"
}
CONTENT = {name: read_yaml(path) for name, path in PAPERS.items()}
FUZZ = settings(
    max_examples=100,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
scalars = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=8),
    st.dates(),
    st.sampled_from([[], {}, "", 0, -1, 10**400, math.nan, math.inf, "{", "{x}", "a/b"]),
)
values = st.recursive(
    scalars,
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.text(max_size=5) | st.integers(), inner, max_size=3)
    ),
    max_leaves=5,
)


def places(content, above=()):
    """Paths to every node of a tree of mappings and lists."""
    yield above
    if isinstance(content, dict | list):
        for key in content if isinstance(content, dict) else range(len(content)):
            yield from places(content[key], (*above, key))


def changed(content, path, value):
    """A copy with another value at a path; `...` removes what is there."""
    content = copy.deepcopy(content)
    holder = content
    for key in path[:-1]:
        holder = holder[key]
    if value is ...:
        del holder[path[-1]]
    else:
        holder[path[-1]] = value
    return content


def refused_in_one_line(work, name):
    """Whether `work` refused its input, in the way that it should."""
    try:
        work()
    except ReproError as error:
        assert "\n" not in str(error) and name in str(error), str(error)
        return True
    return False


PLACES = {name: list(places(content))[1:] for name, content in CONTENT.items()}


@pytest.mark.parametrize("paper", PAPERS)
@FUZZ
@given(choice=st.data())
def test_a_parameter_file_with_anything_in_it(paper, choice, tmp_path):
    path = choice.draw(st.sampled_from(PLACES[paper]))
    value = choice.draw(values | st.just(...))
    content = changed(CONTENT[paper], path, value)
    file = tmp_path / "paper.yaml"
    file.write_text(yaml.safe_dump(content), errors="replace")
    refused_in_one_line(lambda: load_paper(file), str(file))


@FUZZ
@given(
    text=st.text()
    | st.lists(st.sampled_from("{}[]:,-&*!|>?'\"#%@ \n\tab12"), max_size=40).map("".join)
)
def test_a_parameter_file_of_any_text(text, tmp_path):
    file = tmp_path / "paper.yaml"
    file.write_text(text, errors="replace")
    assert refused_in_one_line(lambda: load_paper(file), str(file))


@FUZZ
@given(
    overrides=st.dictionaries(
        st.sampled_from(["trials", "shards", "into", "log", "study", "parameters", "x"]), values
    )
)
def test_any_config(overrides):
    refused_in_one_line(lambda: load_run(ROOT / "params/run.yaml", overrides), "--config")


REGISTERED = registered()
numbers = st.sampled_from([0, 1, 2, 5, -1, 0.0, 0.5, 1.0, 1e-300, 1e-9, 1e9, 1e17, -3.5])
entries = numbers | st.just("x") | st.booleans() | st.none()
lists = st.lists(entries | st.lists(entries, max_size=3), max_size=4)


@pytest.mark.parametrize("study", sorted({study for _, study, _ in REGISTERED} - {"quadrotor"}))
@FUZZ
@given(choice=st.data())
def test_a_point_with_anything_that_its_types_allow(study, choice, tmp_path):
    name, _, point = choice.draw(st.sampled_from([r for r in REGISTERED if r[1] == study]))
    resolved = points()[study][point]
    settings = resolved.filters.get(name, {})
    content = {"parameters": resolved.parameters.plain(), "settings": dict(settings)}
    content["parameters"] |= {"trials": 2, "steps": 3}
    path = choice.draw(st.sampled_from([p for p in places(content) if len(p) > 1]))
    value = choice.draw(entries | lists | st.just(...))
    assume(path[-1] not in ("steps", "particles") or not isinstance(value, int) or value < 100)
    content = changed(content, path, value)
    log = tmp_path / "0.mcap"

    def work():
        settings = checked_settings(name, content["settings"], f"{study}: filters.{name}")
        simulate(study, point, content["parameters"], SEED, (0, 2), log)
        points = {point: FilteredPoint(log, settings)}
        run_filter(study, name, points, tmp_path / "0.npz")

    with np.errstate(all="ignore"):
        refused_in_one_line(work, study)


STUDY, POINT = "linear_delays", "arrival=0.5"
LOG = small_log(STUDY, POINT, trials=2, steps=4)


@FUZZ
@given(
    changes=st.lists(
        st.tuples(st.integers(0, 10**4), st.binary(max_size=12), st.integers(0, 9)),
        min_size=1,
        max_size=4,
    )
)
def test_a_log_with_pieces_replaced(changes, tmp_path):
    path = tmp_path / "0.mcap"
    write_log(path, LOG, period=0.5)
    data = path.read_bytes()
    for start, piece, length in changes:
        start %= len(data)
        data = data[:start] + piece + data[start + length :]
    path.write_bytes(data)
    refused_in_one_line(lambda: read_log(path), "0.mcap")
    refused_in_one_line(
        lambda: read_user_log(path, LOG.fields, STUDY, POINT, LOG.parameters), "0.mcap"
    )


@FUZZ
@given(
    rows=st.lists(
        st.tuples(
            st.sampled_from(sorted(LOG.fields)),
            st.dictionaries(st.sampled_from(["trial", "step", "x1", "x2", "z"]), values) | values,
        ),
        max_size=6,
    )
)
def test_a_user_log_of_any_json(rows, tmp_path):
    path = tmp_path / "user.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        channels = {topic: writer.register_channel(topic, "json", 0) for topic in LOG.fields}
        for time, (topic, row) in enumerate(rows):
            writer.add_message(channels[topic], time, json.dumps(row, default=str).encode(), time)
        writer.finish()
    refused_in_one_line(
        lambda: read_user_log(path, LOG.fields, STUDY, POINT, LOG.parameters), "user.mcap"
    )
    refused_in_one_line(lambda: read_log(path), "user.mcap")


@FUZZ
@given(
    text=st.text()
    | st.lists(
        st.sampled_from(["float64 ", "int32 ", "x1", "x2", "\n", "===", "#", " ", "[3]", "=1"])
    ).map("".join),
    payload=st.binary(max_size=40),
)
def test_a_user_log_of_any_schema(text, payload, tmp_path):
    path = tmp_path / "user.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        for topic in LOG.fields:
            schema = writer.register_schema("a/b", "ros2msg", text.encode(errors="replace"))
            channel = writer.register_channel(topic, "cdr", schema)
            writer.add_message(channel, 0, payload, 0)
        writer.finish()
    refused_in_one_line(
        lambda: read_user_log(path, LOG.fields, STUDY, POINT, LOG.parameters), "user.mcap"
    )
    refused_in_one_line(lambda: read_log(path), "user.mcap")
