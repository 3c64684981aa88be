"""What the messages of a log recorded elsewhere may hold, how many, and what is refused."""

import json
import struct
import tracemalloc

import lz4.frame
import numpy as np
import pytest
import zstandard
from mcap.data_stream import RecordBuilder
from mcap.records import Chunk
from mcap.writer import CompressionType, Writer
from mcap_ros2.writer import Writer as Ros2Writer

from repro.logs import LogError
from repro.logs.format import MAGIC
from repro.logs.user_log import read_user_log
from tests.conftest import points, small_log

STUDY, POINT = "linear_delays", "arrival=0.5"


def read(path, names=("x1", "x2")):
    return read_user_log(path, {"/truth": names}, STUDY, POINT, points()[STUDY][POINT].parameters)


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
