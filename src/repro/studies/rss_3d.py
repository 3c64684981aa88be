"""Tracking by received signal strength in space (Song et al., Sec. IV-B; Figures 11-13)."""

import numpy as np

from repro.models.sensor_network import SensorNetwork
from repro.studies.families import harvesting_sensors, signal_strength
from repro.studies.families.harvesting_sensors import channels, error
from repro.studies.families.signal_strength import lost, simulate

__all__ = ["channels", "error", "lost", "simulate"]

STATE = signal_strength.state(3)
TRAJECTORY = (("s_x", "s_y"),)
COMPONENTS = signal_strength.components(3)
TRIALS_A_BLOCK = 20


def topics(parameters: dict) -> dict[str, tuple[str, ...]]:
    return harvesting_sensors.topics(STATE, parameters["sensors"])


def period(parameters: dict) -> float:
    return parameters["sampling_time"]


def model(parameters: dict) -> SensorNetwork:
    mean = np.array(parameters["true_initial_state"])[:, None]
    deviation = np.sqrt(parameters["prior_variances"])[:, None]

    def draw_prior(streams, particles):
        drawn = streams.standard_normal(len(mean), particles)
        drawn *= deviation
        drawn += mean
        return drawn

    return signal_strength.model(parameters, draw_prior)


def rows(shards):
    return harvesting_sensors.rmse_rows(shards, COMPONENTS, lost)


def curves(shards):
    return harvesting_sensors.rmse_curves(shards, COMPONENTS)
