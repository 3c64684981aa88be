"""One trial in detail."""

import json

import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from repro.errors import ReproError
from repro.inspect.view import LAYOUT, write_view
from repro.runner import flown, run
from tests.conftest import points, small_log

STUDY, POINT, FILTERS = "wsn_tracking", "n2-arrival=0.9", ["emvf", "ekf"]


FILTERED = {name: points()[STUDY][POINT].filters.get(name, {}) for name in FILTERS}


@pytest.fixture(scope="module")
def log():
    return small_log(STUDY, POINT, trials=3, steps=10)


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


def test_view_has_the_log_and_every_filters_estimate_on_one_clock(log, tmp_path):
    write_view(log, FILTERED, 2, tmp_path / "v.mcap", tmp_path / "v.json")
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
        estimate, _ = run(log, name, FILTERED[name])  # of all trials at once
        assert [m.px for m in found[f"/estimate/{name}"]] == estimate[2, :, 0].tolist()
    layout = attached[LAYOUT]
    assert layout == json.loads((tmp_path / "v.json").read_text())
    assert_layout_names_what_is_there(layout, found)


def test_a_view_of_a_closed_loop_has_every_filters_own_flight(tmp_path):
    point, filters = "nominal", ["ekf", "rbpf_fast"]
    log = small_log("quadrotor", point, trials=3, steps=10)
    settings = {name: points()["quadrotor"][point].filters.get(name, {}) for name in filters}
    write_view(log, settings, 1, tmp_path / "v.mcap", tmp_path / "v.json")
    found = read_decoded(tmp_path / "v.mcap")
    for name in filters:
        truth = flown(log, name, settings[name]).values["/truth"][1]
        assert [m.z for m in found[f"/truth/{name}"]] == truth[:, 11].tolist()
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


def test_a_trial_that_is_not_there_is_named(log, tmp_path):
    with pytest.raises(ReproError, match=r"trial 3: .* has the trials 0 to 2"):
        write_view(log, FILTERED, 3, tmp_path / "v.mcap", tmp_path / "v.json")
