"""A filter on logs recorded elsewhere."""

import json

import numpy as np
import pandas as pd
import pytest
from mcap.writer import Writer
from mcap_ros2.writer import Writer as Ros2Writer

from repro.errors import ReproError
from repro.inspect.user_log import run_own
from repro.run import run
from tests.conftest import points, small_log

STUDY, POINT = "linear_delays", "arrival=0.5"


@pytest.fixture
def log():
    return small_log(STUDY, POINT, trials=1, steps=8)


@pytest.fixture
def asked(log):
    settings = points()[STUDY][POINT].filters["omvf"]
    return {"study": STUDY, "point": POINT, "parameters": log.parameters, "settings": settings}


def record(path, log, encoding, topics, extra=True):
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
                row |= {"quality": 1} if extra else {}
                if encoding == "json":
                    data = json.dumps(row).encode()
                    writer.add_message(channels[topic], k * 1000, data, k * 1000)
                else:
                    writer.write_message(topic, schemas[topic], row, log_time=k * 1000)
        writer.finish()


@pytest.mark.parametrize("encoding", ["json", "cdr"])
def test_estimates_are_those_of_the_projects_own_log(encoding, log, asked, tmp_path):
    record(tmp_path / "own.mcap", log, encoding, list(log.fields))
    run_own(tmp_path / "own.mcap", asked, "omvf", tmp_path / "own.csv")
    table = pd.read_csv(tmp_path / "own.csv")
    estimate, runs = run(log, "omvf", asked["settings"])
    np.testing.assert_allclose(table[["x1", "x2"]], estimate[0], rtol=1e-8)
    np.testing.assert_allclose(table[["error_x1", "error_x2"]], runs.error[0], rtol=1e-7, atol=1e-8)


def test_without_truth_there_are_estimates_and_no_errors(log, asked, tmp_path):
    record(tmp_path / "own.mcap", log, "json", ["/received", "/network"])
    with pytest.raises(ReproError, match="topic /sensor: missing"):
        run_own(tmp_path / "own.mcap", asked, "omvf", tmp_path / "own.csv")
    record(tmp_path / "own.mcap", log, "json", ["/sensor", "/received", "/network"])
    run_own(tmp_path / "own.mcap", asked, "omvf", tmp_path / "own.csv")
    table = pd.read_csv(tmp_path / "own.csv")
    assert list(table.columns) == ["trial", "k", "x1", "x2"] and len(table) == log.steps


def test_a_log_that_lacks_a_field_is_refused_in_one_line(log, asked, tmp_path):
    bad = log._replace(fields=log.fields | {"/sensor": ("reading",)})
    record(tmp_path / "own.mcap", bad, "json", list(log.fields))
    with pytest.raises(ReproError, match="topic /sensor: the field 'z' is missing"):
        run_own(tmp_path / "own.mcap", asked, "omvf", tmp_path / "own.csv")
