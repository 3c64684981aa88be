"""A filter on logs recorded elsewhere."""

import json
import struct

import numpy as np
import pandas as pd
import pytest
from mcap.writer import Writer
from mcap_ros2.writer import Writer as Ros2Writer

from repro.errors import ReproError
from repro.inspect.user_log import run_user_log
from repro.logs import LogError
from repro.logs.user_log import read_user_log
from repro.runner import run
from tests.conftest import points, small_log

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
    record(tmp_path / "user.mcap", log, "json", ["/received", "/network"])
    with pytest.raises(ReproError, match="topic /sensor: missing"):
        run_user_log(tmp_path / "user.mcap", user_log, "omvf", tmp_path / "estimates.csv")
    record(tmp_path / "user.mcap", log, "json", ["/sensor", "/received", "/network"])
    run_user_log(tmp_path / "user.mcap", user_log, "omvf", tmp_path / "estimates.csv")
    table = pd.read_csv(tmp_path / "estimates.csv")
    assert list(table.columns) == ["trial", "k", "x1", "x2"] and len(table) == log.steps


def test_a_log_that_lacks_a_field_is_refused_in_one_line(log, user_log, tmp_path):
    bad = log._replace(fields=log.fields | {"/sensor": ("reading",)})
    record(tmp_path / "user.mcap", bad, "json", list(log.fields))
    with pytest.raises(ReproError, match="topic /sensor: the field 'z' is missing"):
        run_user_log(tmp_path / "user.mcap", user_log, "omvf", tmp_path / "estimates.csv")


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
    ],
)
def test_faults_of_a_log_are_named_in_one_line(changes, message, tmp_path):
    path = tmp_path / "user.mcap"
    write_raw(path, **{"schema_text": FIELDS, "payload": PAYLOAD} | changes)
    with pytest.raises(LogError, match=rf"user\.mcap: topic /truth: .*{message}") as error:
        read(path)
    assert "\n" not in str(error.value)
