import io
import json

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap.writer import Writer
from mcap_ros2.decoder import DecoderFactory

from repro import plugins
from repro.errors import ReproError
from repro.logs import LogError, read_log, read_parameters, selected, write_log
from repro.origin import origin
from repro.runner import read_checked_log
from tests.conftest import points, small_log

STUDY, POINT = "linear_delays", "arrival=0.5"


@pytest.fixture
def log():
    return small_log(STUDY, POINT, trials=3, steps=5)


@pytest.fixture
def path(log, tmp_path):
    write_log(tmp_path / "0.mcap", log, period=0.5)
    return tmp_path / "0.mcap"


def assert_same(read, log):
    assert (read.study, read.point, read.seed) == (log.study, log.point, log.seed)
    assert read.parameters == log.parameters and read.fields == log.fields
    np.testing.assert_array_equal(read.trials, log.trials)
    for topic, values in log.values.items():
        np.testing.assert_array_equal(read.values[topic], values)


def test_round_trip(path, log):
    assert_same(read_log(path), log)
    assert_same(read_log(path, log.fields, STUDY, POINT), log)


def test_equal_content_gives_equal_bytes(path, log, tmp_path):
    write_log(tmp_path / "again.mcap", log, period=0.5)
    assert (tmp_path / "again.mcap").read_bytes() == path.read_bytes()


def test_official_reader_and_ros2_decoder_agree(path, log):
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        assert reader.get_summary().statistics.message_count == 4 * 3 * 6
        times = []
        for _, channel, message, decoded in reader.iter_decoded_messages():
            values = log.values[channel.topic][decoded.trial, decoded.step]
            found = [getattr(decoded, name) for name in log.fields[channel.topic]]
            assert found == values.tolist()
            assert message.log_time == (decoded.trial * 6 + decoded.step) * 500_000_000
            times.append(message.log_time)
        assert times == sorted(times) and len(times) == 4 * 3 * 6
        assert json.loads(next(reader.iter_attachments()).data) == log.parameters.plain()
        assert next(reader.iter_metadata()).metadata["study"] == STUDY


@pytest.mark.parametrize("study", ["linear_delays", "linear_losses", "radar", "wsn_tracking"])
def test_what_a_log_leaves_out_is_read_as_it_was_simulated(study, tmp_path):
    scenario = plugins.study(study)
    for point in points()[study]:
        log = small_log(study, point, trials=2)
        stored = scenario.stored(log.parameters)
        assert stored != log.fields
        write_log(tmp_path / "0.mcap", selected(log, stored), period=0.5)
        read = read_log(tmp_path / "0.mcap")
        assert read.fields == log.fields and list(read.values) == list(log.values)
        for topic, values in log.values.items():
            assert read.values[topic].tobytes() == values.tobytes(), (point, topic)


@pytest.mark.parametrize("study", sorted(points()))
def test_the_ros2_decoder_reads_the_logs_of_every_study(study, tmp_path):
    log = small_log(study, next(iter(points()[study])), trials=1, steps=3)
    write_log(tmp_path / "0.mcap", log, period=0.5)
    with (tmp_path / "0.mcap").open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for _, channel, _, decoded in reader.iter_decoded_messages():
            values = log.values[channel.topic][decoded.trial, decoded.step]
            assert [getattr(decoded, name) for name in log.fields[channel.topic]] == values.tolist()


def test_no_changed_byte_goes_unnoticed(path, tmp_path):
    data = path.read_bytes()
    broken = tmp_path / "broken.mcap"
    for position in range(len(data)):
        changed = bytearray(data)
        changed[position] ^= 1 << (position % 8)
        broken.write_bytes(changed)
        with pytest.raises(LogError, match=r"broken\.mcap") as error:
            read_log(broken)
        assert "\n" not in str(error.value)


def test_no_changed_byte_gives_other_parameters(path, log, tmp_path):
    """Where they are read alone; of the messages, which come later, nothing is read."""
    data = path.read_bytes()
    first = data.index(b"uint32 trial")  # of the first schema
    (tmp_path / "head.mcap").write_bytes(data[:first])
    assert read_parameters(tmp_path / "head.mcap") == read_parameters(path) == log.parameters
    broken = tmp_path / "broken.mcap"
    start = data.index(b"parameters.json")
    for position in range(start, data.rindex(b"}", 0, first)):
        changed = bytearray(data)
        changed[position] ^= 1 << (position % 8)
        broken.write_bytes(changed)
        with pytest.raises(ReproError, match=r"broken\.mcap") as error:
            read_parameters(broken)
        assert "\n" not in str(error.value)
    with pytest.raises(LogError, match=r"none\.mcap: the log cannot be read"):
        read_parameters(tmp_path / "none.mcap")
    with pytest.raises(ReproError, match="stale"):
        read_parameters(path, origin("5", (0, 3)))


def test_no_truncation_goes_unnoticed(path, tmp_path):
    data = path.read_bytes()
    broken = tmp_path / "broken.mcap"
    for length in range(0, len(data), 7):
        broken.write_bytes(data[:length])
        with pytest.raises(LogError, match="truncated"):
            read_log(broken)


def write_messages(path, log, encoding="json", leave_out=None):
    """An ordinary log as another tool would record it: step by step, topics interleaved."""
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start()
    writer.add_metadata(
        "provenance", {"study": log.study, "point": log.point, "root_seed": str(log.seed)}
    )
    writer.add_attachment(
        0, 0, "parameters.json", "application/json", json.dumps(log.parameters.plain()).encode()
    )
    channels = {}
    for topic in log.fields:
        if topic != leave_out:
            schema = writer.register_schema(topic, "jsonschema", b"{}")
            channels[topic] = writer.register_channel(topic, encoding, schema)
    for trial in range(len(log.trials)):
        for step in range(log.values["/truth"].shape[1]):
            for topic, channel in channels.items():
                values = log.values[topic][trial, step]
                row = dict(zip(log.fields[topic], values.tolist(), strict=True))
                text = json.dumps({"trial": trial, "step": step} | row)
                writer.add_message(channel, step, text.encode(), step)
    writer.finish()
    path.write_bytes(stream.getvalue())


def test_a_json_log_of_the_same_topics_is_read(log, tmp_path):
    write_messages(tmp_path / "json.mcap", log)
    assert_same(read_log(tmp_path / "json.mcap", log.fields), log)


def test_faults_are_named_in_one_line(path, log, tmp_path):
    expected = {**log.fields, "/ideal": ("z",)}
    with pytest.raises(LogError, match=r"0\.mcap: topic /ideal: missing"):
        read_log(path, expected)
    with pytest.raises(LogError, match=r"topic /sensor: wrong schema .* expected .* range"):
        read_log(path, {**log.fields, "/sensor": ("range",)})
    with pytest.raises(LogError, match="study 'linear_delays', expected is 'radar'"):
        read_log(path, study="radar")
    with pytest.raises(LogError, match=r"point 'arrival=0\.5', expected is 'arrival=0\.6'"):
        read_checked_log(path, STUDY, "arrival=0.6")
    with pytest.raises(ReproError, match=r"0\.mcap: stale: it does not say what it was made with"):
        read_checked_log(path, STUDY, "arrival=0.5", origin("5", (0, 3)))
    write_log(path, log, 1.0, origin=origin("5", (0, 3)))
    read_checked_log(path, STUDY, "arrival=0.5", origin("5", (0, 3)))
    with pytest.raises(ReproError, match="it has trials 0 to 2, and trials 0 to 3 are asked for"):
        read_checked_log(path, STUDY, "arrival=0.5", origin("5", (0, 4)))
    with pytest.raises(ReproError, match="other parameters, seed or code than now"):
        read_checked_log(path, STUDY, "arrival=0.5", origin("6", (0, 3)))
    with pytest.raises(LogError, match=r"none\.mcap: the log cannot be read"):
        read_log(tmp_path / "none.mcap")
    write_messages(tmp_path / "odd.mcap", log, encoding="protobuf")
    with pytest.raises(LogError, match="topic /truth: encoding 'protobuf'"):
        read_log(tmp_path / "odd.mcap", log.fields)
    write_messages(tmp_path / "less.mcap", log, leave_out="/received")
    with pytest.raises(LogError, match="topic /received: missing"):
        read_checked_log(tmp_path / "less.mcap", STUDY, POINT)


def test_a_missing_or_repeated_step_is_named(log, tmp_path):
    doubled = log._replace(trials=np.array([0, 1, 1]))
    write_log(tmp_path / "doubled.mcap", doubled, period=1.0)
    with pytest.raises(LogError, match="trial 0 has fewer than 12 messages"):
        read_log(tmp_path / "doubled.mcap")


@pytest.mark.parametrize("number", [np.nan, np.inf, -np.inf])
def test_a_log_of_ones_own_pipeline_holds_no_number_that_is_not_finite(log, tmp_path, number):
    log.values["/received"][1, 2, 0] = number
    write_log(tmp_path / "nan.mcap", log, period=1.0)
    field = log.fields["/received"][0]
    with pytest.raises(LogError, match=f"/received: the field '{field}' of trial 1, step 2 is"):
        read_log(tmp_path / "nan.mcap")


def test_large_numbers_are_finite(log, tmp_path):
    log.values["/received"][:, :, 0] = 1e308
    write_log(tmp_path / "large.mcap", log, period=1.0)
    assert_same(read_log(tmp_path / "large.mcap"), log)
