"""A filter on logs recorded elsewhere."""

import json
import struct
import tracemalloc

import lz4.frame
import numpy as np
import pandas as pd
import pytest
import zstandard
from mcap.data_stream import RecordBuilder
from mcap.records import Chunk
from mcap.writer import CompressionType, Writer
from mcap_ros2.writer import Writer as Ros2Writer

from repro import plugins
from repro.errors import ReproError
from repro.inspect.user_log import run_user_log
from repro.logs import LogError, write_log
from repro.logs.format import MAGIC
from repro.logs.user_log import read_user_log
from repro.parameters.load import load_run, user_values
from repro.runner import run, run_filter
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
    run_filter(path, study, log.point, name, settings, tmp_path / "0.npz")
    given = {"study": study, "point": log.point, "settings": settings, "seed": 99}
    given["parameters"] = points()[study][log.point].parameters.plain()
    run_user_log(path, given, name, tmp_path / "estimates.csv")
    table = pd.read_csv(tmp_path / "estimates.csv")
    error = table[[f"error_{state}" for state in log.fields["/truth"]]].to_numpy()
    with np.load(tmp_path / "0.npz") as runs:
        np.testing.assert_allclose(
            error.reshape(runs["error"].shape), runs["error"], rtol=1e-7, atol=1e-7
        )


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


def test_one_topic_on_two_channels_is_refused(tmp_path):
    path = tmp_path / "user.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        for time in range(4):
            channel = writer.register_channel("/truth", "json", 0, {"publisher": str(time % 2)})
            writer.add_message(channel, time, b'{"x1": 1, "x2": 2}', time)
        writer.finish()
    with pytest.raises(LogError, match=r"topic /truth: it has .* channels; record it from one"):
        read(path)


@pytest.mark.parametrize("compression", [CompressionType.ZSTD, CompressionType.LZ4])
def test_a_small_file_of_many_bytes_is_refused_before_it_is_decompressed(
    compression, tmp_path, monkeypatch
):
    path = tmp_path / "user.mcap"
    message = b'{"x1": 1, "x2": 2, "note": "%s"}' % (b"0" * 10**6)
    with path.open("wb") as stream:
        writer = Writer(stream, compression=compression)
        writer.start()
        channel = writer.register_channel("/truth", "json", 0)
        for time in range(40):
            writer.add_message(channel, time, message, time)
        writer.finish()
    assert path.stat().st_size < 10**6
    assert read(path).values["/truth"].shape == (1, 40, 2)
    monkeypatch.setattr("repro.logs.user_log.LARGEST", 2 * 10**7)
    with pytest.raises(LogError, match=r"too large: .* MB of records, at most 19 MB are read"):
        read(path)


def write_json(path, messages):
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        channel = writer.register_channel("/truth", "json", 0)
        for time, message in enumerate(messages):
            writer.add_message(channel, time, json.dumps(message).encode(), time)
        writer.finish()


def test_a_log_of_many_small_messages_is_refused_before_they_are_decoded(tmp_path, monkeypatch):
    path = tmp_path / "user.mcap"
    write_json(path, [{"x1": k, "x2": 2} for k in range(100)])
    assert read(path).values["/truth"].shape == (1, 100, 2)
    monkeypatch.setattr("repro.logs.user_log.MOST", 99)
    with pytest.raises(LogError, match=r"too large: at most 99 messages are read; record only"):
        read(path)


def test_one_long_trial_among_many_short_ones_takes_no_memory(tmp_path):
    path, numbers = tmp_path / "user.mcap", range(2000)
    long = [{"x1": 1, "x2": 2, "trial": 0, "step": k} for k in numbers]
    write_json(path, long + [{"x1": 1, "x2": 2, "trial": k, "step": 0} for k in numbers[1:]])
    tracemalloc.start()
    with pytest.raises(LogError, match="trial 1 has fewer than 2000 messages"):
        read(path)
    assert tracemalloc.get_traced_memory()[1] < 2**24
    tracemalloc.stop()


@pytest.mark.parametrize("compression", ["zstd", "lz4"])
def test_a_chunk_never_becomes_larger_than_it_states(compression, tmp_path):
    packed = {"zstd": zstandard.compress, "lz4": lz4.frame.compress}[compression](b"0" * 10**6)
    builder = RecordBuilder()
    Chunk(compression, packed, 0, 0, 0, uncompressed_size=100).write(builder)
    path = tmp_path / "user.mcap"
    path.write_bytes(MAGIC + builder.end() + MAGIC)
    with pytest.raises(LogError, match=r"a chunk of another size than it states|Decompression"):
        read(path)


HEADER = """
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: robot_msgs/Pose
float64[3] position
"""


def write_cdr(path, fields, rows, nested=HEADER):
    """A log with the topic /truth alone, whose messages have the given fields."""
    with path.open("wb") as stream:
        writer = Ros2Writer(stream)
        schema = writer.register_msgdef("robot_msgs/msg/State", fields + nested)
        for time, row in enumerate(rows):
            writer.write_message("/truth", schema, row, log_time=time)
        writer.finish()


def read(path, names=("x1", "x2")):
    return read_user_log(path, {"/truth": names}, STUDY, POINT, points()[STUDY][POINT].parameters)


def test_messages_may_have_headers_strings_arrays_and_nested_messages(tmp_path):
    path = tmp_path / "user.mcap"
    fields = (
        "std_msgs/Header header\nfloat64 x1\nstring[] notes\nPose pose\nint16 x2\nfloat32[] ranges"
    )
    rows = [
        {
            "header": {"stamp": {"sec": k, "nanosec": 0}, "frame_id": "map" * k},
            "x1": 0.5 * k,
            "notes": ["a"] * k,
            "pose": {"position": [1.0, 2.0, 3.0]},
            "x2": -k,
            "ranges": [1.0] * (k % 3),
        }
        for k in range(20)
    ]
    write_cdr(path, fields, rows)
    values = [[[0.5 * k, -k] for k in range(20)]]
    np.testing.assert_array_equal(read(path).values["/truth"], values)


def test_fields_are_found_in_the_messages_inside(tmp_path):
    path = tmp_path / "user.mcap"
    vector = f"{'=' * 80}\nMSG: geometry_msgs/Vector3\nfloat64 x1\nfloat64 x2\n"
    write_cdr(path, "geometry_msgs/Vector3 position\n", [{"position": {"x1": 1, "x2": 2}}], vector)
    np.testing.assert_array_equal(read(path).values["/truth"], [[[1, 2]]])
    write_raw(path, b"", b'{"a": {"b": {"x2": 2}}, "x1": 1, "c": {"x1": 9}}', "json")
    np.testing.assert_array_equal(read(path).values["/truth"], [[[1, 2]]])
    write_raw(path, b"", b'{"a": {"x2": 2}, "x1": 1, "c": {"x2": 9}}', "json")
    with pytest.raises(LogError, match=r"the field 'x2' may be a\.x2 or c\.x2: keep one"):
        read(path)


def test_constants_and_defaults_of_a_schema_are_skipped(tmp_path):
    path = tmp_path / "user.mcap"
    fields = 'float64 LIMIT=3.5\nuint8 GOOD=1\nfloat64 x1 1.25\nstring name "a b"\nfloat64 x2\n'
    write_cdr(path, fields, [{"x2": 2.0}], "")
    np.testing.assert_array_equal(read(path).values["/truth"], [[[1.25, 2.0]]])


def test_what_a_terminal_would_obey_is_shown_escaped(tmp_path):
    path = tmp_path / "user.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        writer.add_message(writer.register_channel("/\x1b[31mx", "json", 0), 0, b"{}", 0)
        writer.finish()
    with pytest.raises(LogError, match=r"topic /truth: missing; topics of the log: /\\x1b\[31mx"):
        read_user_log(
            path,
            {"/truth": ()},
            STUDY,
            POINT,
            small_log(STUDY, POINT).parameters,
            reasons={"/truth": ""},
        )


def test_big_endian_messages_are_read(tmp_path):
    path = tmp_path / "user.mcap"
    payload = b"\0\0\0\0" + struct.pack(">dd", 1.5, -2.0)
    write_raw(path, b"float64 x1\nfloat64 x2\n", payload)
    np.testing.assert_array_equal(read(path).values["/truth"], [[[1.5, -2.0]]])


def write_raw(path, schema_text, payload, encoding="cdr", schema_encoding="ros2msg"):
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema("robot_msgs/msg/State", schema_encoding, schema_text)
        writer.add_message(writer.register_channel("/truth", encoding, schema), 0, payload, 0)
        writer.finish()


PAYLOAD = b"\0\1\0\0" + struct.pack("<dd", 1.0, 2.0)
FIELDS = b"float64 x1\nfloat64 x2\n"


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"encoding": "protobuf"}, "encoding 'protobuf': it must be json, or cdr with a ros2msg"),
        ({"schema_encoding": "ros2idl"}, "encoding 'cdr': it must be json, or cdr with a ros2msg"),
        ({"schema_text": b"float64 x1\n"}, "the field 'x2' is missing"),
        ({"schema_text": b"float64 x1\nstring x2\n"}, "the field .x2. is not a number"),
        ({"schema_text": b"float64 x1\nfloat32[2] x2\n"}, "the field 'x2' is not a number"),
        ({"schema_text": b"float64 x1\nfloat64 x1\n"}, "its schema is not ros2msg.*duplicate"),
        ({"schema_text": b"float64 x1\nunknown_msgs/X x2\n"}, "a message does not fit its schema"),
        ({"schema_text": FIELDS + b"uint32 step\n"}, "a message does not fit its schema"),
        ({"payload": PAYLOAD[:-1]}, "a message does not fit its schema"),
        ({"payload": b"\0\3" + PAYLOAD[2:]}, "a message is not plain cdr"),
        ({"payload": b""}, "a message is not plain cdr"),
        ({"payload": b"[1]", "encoding": "json"}, "a message is not a JSON object"),
        ({"payload": b"{", "encoding": "json"}, "a message is not JSON"),
        ({"payload": b'{"x1": 1, "x2": "2"}', "encoding": "json"}, "'x2' is not a number"),
        ({"payload": b'{"x1": 1, "x2": null}', "encoding": "json"}, "'x2' is not a number"),
        ({"payload": b'{"x1": 1, "x2": 1%s}' % (b"0" * 400), "encoding": "json"}, "too large"),
        (
            {"payload": b'{"x1": 1, "x2": 1, "trial": 0.5, "step": 0}', "encoding": "json"},
            "the field 'trial' must be an integer",
        ),
        (
            {"payload": b'{"x1": 1, "x2": 1, "trial": -1, "step": 0}', "encoding": "json"},
            "the field 'trial' must be an integer",
        ),
        (
            {"payload": b'{"x1": 1, "x2": 1, "trial": NaN, "step": 0}', "encoding": "json"},
            "the field 'trial' must be an integer",
        ),
        (
            {"payload": b'{"x1": 1, "x2": 1, "trial": 1%s, "step": 0}' % (b"0" * 400)}
            | {"encoding": "json"},
            "the field 'trial' has a number that is too large",
        ),
        ({"payload": b'{"x1": 1, "x2": 1, "step": 0}', "encoding": "json"}, "without 'trial'"),
        ({"payload": b'{"x1": 1, "x2": 1, "trial": 0}', "encoding": "json"}, "without 'step'"),
        ({"payload": b'{"x1": 1, "x2": NaN}', "encoding": "json"}, "trial 0, step 0 is nan"),
        ({"payload": b'{"x1": 1, "x2": -Infinity}', "encoding": "json"}, "step 0 is -inf"),
        ({"payload": b'{"x1": ' + b"[" * 10**5, "encoding": "json"}, "nested too deeply"),
        ({"payload": b'{"x": ' * 10**5, "encoding": "json"}, "nested too deeply"),
        ({"schema_text": b"float64 x1\xff\n"}, "its schema is not ros2msg: Unicode"),
    ],
)
def test_faults_of_a_log_are_named_in_one_line(changes, message, tmp_path):
    path = tmp_path / "user.mcap"
    write_raw(path, **{"schema_text": FIELDS, "payload": PAYLOAD} | changes)
    with pytest.raises(LogError, match=rf"user\.mcap: topic /truth: .*{message}") as error:
        read(path)
    assert "\n" not in str(error.value)
