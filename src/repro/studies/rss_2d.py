"""Tracking by received signal strength in the plane (Song et al., Sec. IV-B; Figures 3-10)."""

import numpy as np

from repro.models.sensor_network import SensorNetwork
from repro.studies import _energy_harvesting, _signal_strength
from repro.studies._energy_harvesting import TRIALS_A_BLOCK, channels, error
from repro.studies._signal_strength import lost, simulate

__all__ = ["TRIALS_A_BLOCK", "channels", "error", "lost", "simulate"]

STATE = _signal_strength.state(2)
TRAJECTORY = (("s_x", "s_y"),)
COMPONENTS = _signal_strength.components(2)


def topics(parameters: dict) -> dict[str, tuple[str, ...]]:
    return _energy_harvesting.topics(STATE, parameters["sensors"])


def period(parameters: dict) -> float:
    return parameters["sampling_time"]


def model(parameters: dict) -> SensorNetwork:
    x, v_x, y, v_y = parameters["true_initial_state"]
    speed, azimuth = np.hypot(v_x, v_y), np.arctan2(v_y, v_x)

    def draw_prior(streams, particles):
        drawn = streams.standard_normal(4, particles)
        speeds = speed + np.sqrt(parameters["prior_speed_variance"]) * drawn[:, 1]
        azimuths = azimuth + np.sqrt(parameters["prior_azimuth_variance"]) * drawn[:, 3]
        deviation = np.sqrt(parameters["prior_position_variance"])
        drawn[:, 0] = x + deviation * drawn[:, 0]
        drawn[:, 2] = y + deviation * drawn[:, 2]
        drawn[:, 1] = speeds * np.cos(azimuths)
        drawn[:, 3] = speeds * np.sin(azimuths)
        return drawn

    return _signal_strength.model(parameters, draw_prior)


def rows(shards):
    return _energy_harvesting.rmse_rows(shards, COMPONENTS, lost)


def curves(shards):
    return _energy_harvesting.rmse_curves(shards, COMPONENTS)
