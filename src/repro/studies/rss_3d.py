"""Tracking by received signal strength in space (Song et al., Sec. IV-B; Figures 11-13)."""

import numpy as np

from repro.models.sensor_network import SensorNetwork
from repro.studies import _energy_harvesting, _signal_strength
from repro.studies._energy_harvesting import channels, error
from repro.studies._signal_strength import lost, simulate

__all__ = ["channels", "error", "lost", "simulate"]

STATE = _signal_strength.state(3)
TRAJECTORY = (("s_x", "s_y"),)
COMPONENTS = _signal_strength.components(3)
TRIALS_A_BLOCK = 20


def topics(parameters: dict) -> dict[str, tuple[str, ...]]:
    return _energy_harvesting.topics(STATE, parameters["sensors"])


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

    return _signal_strength.model(parameters, draw_prior)


def rows(shards):
    return _energy_harvesting.rmse_rows(shards, COMPONENTS, lost)


def curves(shards):
    return _energy_harvesting.rmse_curves(shards, COMPONENTS)
