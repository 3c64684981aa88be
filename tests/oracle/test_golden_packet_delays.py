"""Recorded results, to compare other implementations with and to notice any change here."""

import numpy as np
import pytest

from repro.filters import best_in_form, emvf, nahi, omvf, sun
from repro.network import packet_delays
from repro.network.tasking import ScheduledRanges
from repro.parameters.settings import ExtendedMinimumVariance
from repro.studies import wsn_tracking
from tests.conftest import points
from tests.oracle.test_packet_delays import STEPS, filtered, linear_model


@pytest.mark.parametrize(
    ("module", "estimate"),
    [
        (omvf, [0.219216169652, 0.419617762007]),
        (sun, [0.205439933615, 0.400781454925]),
        (best_in_form, [0.205382855206, 0.400740594915]),
        (nahi, [0.285597946604, 0.543598125952]),
    ],
)
def test_linear_filters_on_a_sine(module, estimate):
    """p = 0.5, N = 2, y(k) = sin(k / 10), k = 1 ... 12: xh(12|12)."""
    y = np.sin(0.1 * np.arange(1, STEPS + 1))
    channels = {"received": y, "uncertain": y}
    computed, _ = filtered(module, linear_model(2, 0.5), channels)
    np.testing.assert_allclose(computed, estimate, rtol=1e-10)


# EMVF position error in m at k = 1, 10, 20, 30.
GOLDEN = [9.322593945041314e-05, 0.22095966039716622, 0.426017077529377, 0.27393296069177153]


def test_emvf_on_a_grid_of_sensors():
    """N = 2, p = 0.9, no noise, sensors on a 5 x 4 grid, D(k) = 0 except D(10) = 1, D(20) = 2."""
    point = points()["wsn_tracking"]["n2-arrival=0.9"]
    model = wsn_tracking.STUDY.model(point.parameters)
    x, y = np.meshgrid(np.linspace(10, 90, 5), np.linspace(12.5, 87.5, 4))
    positions = np.stack([x.ravel(), y.ravel()], axis=-1)[None]
    truth = [model.initial_mean]
    for k in range(30):
        truth.append(model.transition(truth[-1], k))
    truth = np.array(truth)
    delay = np.zeros((1, 31), dtype=int)
    delay[0, 10], delay[0, 20] = 1, 2
    offsets = truth[:, None, :2] - positions[0]
    channel = ScheduledRanges(
        positions,
        np.hypot(offsets[..., 0], offsets[..., 1])[None],
        packet_delays.origins(delay),
        np.zeros((1, 31)),
        {},
        model.initial_mean[:2],
        bound=2,
    )
    settings = ExtendedMinimumVariance.checked(point.filters["emvf"], "test")
    filter_ = emvf.build(model, settings)
    state = filter_.init(range(1))
    errors = []
    for k in range(1, 31):
        seen = type("Seen", (), channel.at(k, filter_.predicted(state, k)))
        state = filter_.step(state, k, seen)
        errors.append(np.hypot(*(filter_.mean(state)[0] - truth[k])[:2]))
    np.testing.assert_allclose([errors[0], errors[9], errors[19], errors[29]], GOLDEN, rtol=1e-6)
