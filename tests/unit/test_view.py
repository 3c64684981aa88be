"""One trial to look into."""

import json

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from repro.errors import ReproError
from repro.logs import write_log
from repro.results import Results
from repro.run import run_filter
from repro.view import LAYOUT, write_view
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
    return Results(tmp_path, {STUDY: {POINT: FILTERS}}, shards=1)


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
    series = [path["value"] for panel in layout["configById"].values() for path in panel["paths"]]
    for value in series:
        topic, field = value.rsplit(".", 1)
        assert topic in found and hasattr(found[topic][0], field), value


def test_a_trial_that_is_not_there_is_named(results, tmp_path):
    with pytest.raises(ReproError, match=r"trial 3: .* has the trials 0 to 2; name one"):
        write_view(results, STUDY, POINT, 3, tmp_path / "v.mcap", tmp_path / "v.json")
