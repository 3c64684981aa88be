"""One trial in detail."""

import json

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from repro.errors import ReproError
from repro.inspect.view import LAYOUT, write_view
from repro.logs import write_log
from repro.runner import run_filter
from repro.tables.results import Results
from tests.conftest import points, small_log

STUDY, POINT, FILTERS = "wsn_tracking", "n2-arrival=0.9", ["emvf", "ekf"]


@pytest.fixture
def results(tmp_path):
    log = tmp_path / "logs" / STUDY / POINT / "0.mcap"
    log.parent.mkdir(parents=True)
    write_log(log, small_log(STUDY, POINT, trials=3, steps=10), 0.1)
    for name in FILTERS:
        path = tmp_path / "runs" / STUDY / POINT / name / "0.npz"
        path.parent.mkdir(parents=True)
        settings = points()[STUDY][POINT].filters.get(name, {})
        run_filter(log, STUDY, POINT, name, settings, path)
    return Results(tmp_path, {STUDY: {POINT: FILTERS}}, 1, {}, [], tolerance=3.0)


def read_decoded(path):
    """Messages of a log by topic, by the official reader and decoder."""
    found = {}
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for _, channel, _, decoded in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append(decoded)
    return found


def assert_layout_names_what_is_there(layout, found):
    panels = layout["configById"].values()
    for panel in panels:
        assert panel["foxglovePanelTitle"] and panel["paths"] and "title" not in panel
    for value in (path["value"] for panel in panels for path in panel["paths"]):
        topic, field = value.rsplit(".", 1)
        assert topic in found and hasattr(found[topic][0], field), value


def test_view_has_the_log_and_every_filters_estimate_on_one_clock(results, tmp_path):
    write_view(results, STUDY, POINT, 2, tmp_path / "v.mcap", tmp_path / "v.json")
    log = results.log(STUDY, POINT)
    with (tmp_path / "v.mcap").open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        found, times = {}, {}
        for _, channel, message, decoded in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append(decoded)
            times.setdefault(channel.topic, []).append(message.log_time)
        attached = {a.name: json.loads(a.data) for a in reader.iter_attachments()}
    assert set(found) >= {
        *log.fields,
        *(f"/{t}/{f}" for t in ("estimate", "error") for f in FILTERS),
    }
    assert times["/estimate/emvf"] == times["/truth"] == times["/received"]
    for name in FILTERS:
        error = results.runs(STUDY, POINT, name).error[2]
        estimate = [m.px for m in found[f"/estimate/{name}"]]
        np.testing.assert_allclose(estimate, log.values["/truth"][2, :, 0] + error[:, 0])
    layout = attached[LAYOUT]
    assert layout == json.loads((tmp_path / "v.json").read_text())
    assert_layout_names_what_is_there(layout, found)


def test_a_view_of_a_closed_loop_has_every_filters_own_flight(tmp_path):
    point, filters = "nominal", ["ekf", "rbpf_fast"]
    log = tmp_path / "logs/quadrotor" / point / "0.mcap"
    log.parent.mkdir(parents=True)
    write_log(log, small_log("quadrotor", point, trials=3, steps=10), 0.01)
    for name in filters:
        runs, flights = (
            tmp_path / kind / "quadrotor" / point / name for kind in ("runs", "flights")
        )
        runs.mkdir(parents=True)
        flights.mkdir(parents=True)
        settings = points()["quadrotor"][point].filters.get(name, {})
        run_filter(log, "quadrotor", point, name, settings, runs / "0.npz", flights / "0.mcap")
    catalogue = {"quadrotor": {point: filters}}
    results = Results(tmp_path, catalogue, 1, {}, [], tolerance=3.0)
    write_view(results, "quadrotor", point, 1, tmp_path / "v.mcap", tmp_path / "v.json")
    found = read_decoded(tmp_path / "v.mcap")
    for name in filters:
        flown = results.flight("quadrotor", point, name).values["/truth"][1]
        assert [m.z for m in found[f"/truth/{name}"]] == flown[:, 11].tolist()
        assert {f"/{kind}/{name}" for kind in ("estimate", "error", "received", "throttle")} <= set(
            found
        )
    assert {"/network", "/reference"} <= set(found)
    layout = json.loads((tmp_path / "v.json").read_text())
    assert_layout_names_what_is_there(layout, found)
    # What was flown on each filter and the path, four states beside the path, signals, errors.
    panels = layout["configById"]
    assert len(panels) == len(filters) + 1 + 4 + 1 + 2
    height = {path["label"] for path in panels["Plot!state_z"]["paths"]}
    assert height == {"/reference", *(f"/truth/{name}" for name in filters)}


def test_a_trial_that_is_not_there_is_named(results, tmp_path):
    with pytest.raises(ReproError, match=r"trial 3: .* has the trials 0 to 2"):
        write_view(results, STUDY, POINT, 3, tmp_path / "v.mcap", tmp_path / "v.json")
