"""The network of [packet_delays], and the parameters and points of its studies."""

import numpy as np
import pytest

from repro.network import packet_delays
from repro.network.tasking import ScheduledRanges
from repro.papers.packet_delays.points import linear_points, table_2
from repro.parameters.values import ParameterError
from repro.tables.results import Results
from tests.conftest import points, small_log

# [packet_delays Table 1]: gamma_1 = * where the paper leaves it arbitrary.
GAMMA_0 = [1, 1, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1]
GAMMA_1 = "* * 1 1 * * * 1 0 0 * *".split()
ARRIVES = [1, 2, 2, 3, 5, 6, 7, 7, 7, 8, 11, 12]


@pytest.mark.parametrize("arbitrary", [0.0, 1.0])
def test_table_1_whatever_the_arbitrary_flags_are(arbitrary):
    gamma_1 = [arbitrary if flag == "*" else float(flag) for flag in GAMMA_1]
    flags = np.array([[[1.0, *GAMMA_0], [1.0, *gamma_1]]])  # k = 0 is not in the table
    origin = packet_delays.origins(packet_delays.delays(flags, bound=2))
    assert origin[0, 1:].tolist() == ARRIVES


@pytest.mark.parametrize(("bound", "lossy"), [(0, True), (1, False), (2, False), (2, True)])
def test_delays_have_the_probabilities_of_the_model(bound, lossy):
    p, draws = 0.7, 200_000
    flags = packet_delays.flags_per_step(bound, lossy)
    uniforms = np.random.default_rng(3).random((1, flags, draws))
    delay = packet_delays.delays(packet_delays.arrival_flags(uniforms, p), bound)
    expected = {i: p * (1 - p) ** i for i in range(flags)}
    expected[packet_delays.LOST if flags > bound else bound] = (1 - p) ** flags
    assert sum(expected.values()) == pytest.approx(1)
    for value, probability in expected.items():
        error = np.sqrt(probability * (1 - probability) / draws)
        assert (delay == value).mean() == pytest.approx(probability, abs=5 * error)


def test_mean_weights():
    for bound in (1, 2, 3):
        assert packet_delays.mean_weights(0.3, bound).sum() == pytest.approx(1)
    assert packet_delays.mean_weights(0.3, 0).tolist() == [0.3]
    np.testing.assert_allclose(packet_delays.mean_weights(0.3, 2), [0.3, 0.21, 0.49])
    np.testing.assert_allclose(packet_delays.mean_weights(0.3, 2, "8b"), [0.3, 0.21, 0.147])


def test_received_values_are_late_lost_or_before_the_start():
    z, v = np.array([[10.0, 11.0, 12.0]]), np.array([[0.1, 0.2, 0.3]])
    delay = np.array([[1, 1, packet_delays.LOST]])
    np.testing.assert_array_equal(packet_delays.received(z, v, delay), [[0.0, 10.0, 0.3]])


def test_a_late_range_is_of_the_sensor_tasked_at_its_origin():
    positions = np.array([[[0.0, 0.0], [10.0, 0.0]]])
    ranges = np.arange(6.0).reshape(1, 3, 2)  # range 2k + s of sensor s at step k
    channel = ScheduledRanges(
        positions,
        ranges,
        origin=np.array([[0, 1, 1]]),
        without_packet=np.zeros((1, 3)),
        offered={},
        first=np.zeros(2),
        bound=2,
    )
    assert channel.at(1, np.array([[9.0, 0.0]]))["received"] == 3.0  # on time, sensor 1
    late = channel.at(2, np.array([[1.0, 0.0]]))  # sensor 0 now, but the packet is of k = 1
    assert late["received"] == 3.0
    np.testing.assert_array_equal(late["sensor"], positions[:, 0])
    np.testing.assert_array_equal(
        late["earlier_sensors"], positions[None, 0, [1, 0]].swapaxes(0, 1)
    )


def test_a_sweep_shares_its_flags():
    """Flags of a smaller N and of another p come from the same uniforms."""
    first, second = (
        small_log("wsn_tracking", f"n{n}-arrival=0.9").field("/network", "gamma_0") for n in (1, 2)
    )
    np.testing.assert_array_equal(first, second)


def test_points_are_found_by_their_names(tmp_path):
    catalogue = {
        study: {point: [] for point in points()[study]}
        for study in ("linear_delays", "wsn_tracking")
    }
    results = Results(tmp_path, catalogue, 1, {}, [], 3.0)
    arrivals = ["0.8", "0.85", "0.9", "0.95", "0.99"]
    assert table_2(results) == {0: arrivals, 1: arrivals, 2: arrivals}
    assert list(linear_points(results)) == pytest.approx(np.arange(1, 11) / 10)


def test_a_fixed_layout_has_every_sensor():
    parameters = points()["wsn_tracking"]["reading-layout=fixed@n2-arrival=0.9"].parameters
    with pytest.raises(ParameterError, match="fixed_layout has 20 positions; sensors asks for 19"):
        type(parameters).checked({**parameters.plain(), "sensors": 19}, "test")
