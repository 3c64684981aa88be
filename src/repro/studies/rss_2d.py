"""Tracking by received signal strength in the plane (Song et al., Sec. IV-B; Figures 3-10)."""

import numpy as np

from repro.models.sensor_network import SensorNetwork
from repro.studies.families import harvesting_sensors, signal_strength
from repro.studies.families.harvesting_sensors import TRIALS_A_BLOCK, channels, error
from repro.studies.families.signal_strength import lost, simulate

__all__ = ["TRIALS_A_BLOCK", "channels", "error", "lost", "simulate"]

STATE = signal_strength.state(2)
TRAJECTORY = (("s_x", "s_y"),)
COMPONENTS = signal_strength.components(2)


def topics(parameters: dict) -> dict[str, tuple[str, ...]]:
    return harvesting_sensors.topics(STATE, parameters["sensors"])


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

    return signal_strength.model(parameters, draw_prior)


def rows(shards):
    return harvesting_sensors.rmse_rows(shards, COMPONENTS, lost)


def curves(shards):
    return harvesting_sensors.rmse_curves(shards, COMPONENTS)
