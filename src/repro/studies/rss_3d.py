"""Tracking by received signal strength in space (Song et al., Sec. IV-B; Figures 11-13)."""

from typing import Annotated

import numpy as np
from pydantic import Field

from repro.models.sensor_network import SensorNetwork
from repro.parameters.values import Positive, Triple
from repro.studies import Fields
from repro.studies.families import harvesting_sensors, signal_strength
from repro.studies.families.signal_strength import SignalStrengthParameters, SignalStrengthStudy

STATE = signal_strength.state(3)


class Parameters(SignalStrengthParameters):
    """Values of one point."""

    sensor_positions: Annotated[tuple[Triple, ...], Field(min_length=1)]
    true_initial_state: tuple[float, float, float, float, float, float]
    prior_variances: tuple[Positive, Positive, Positive, Positive, Positive, Positive]


class Rss3d(SignalStrengthStudy):
    """Tracking by received signal strength in space."""

    Parameters = Parameters
    systems_per_block = 20
    trajectory = (("s_x", "s_y"),)
    components = signal_strength.components(3)

    def topics(self, parameters: Parameters) -> Fields:
        return harvesting_sensors.topics(STATE, parameters.sensors)

    def model(self, parameters: Parameters) -> SensorNetwork:
        mean = np.array(parameters.true_initial_state)[:, None]
        deviation = np.sqrt(parameters.prior_variances)[:, None]

        def draw_prior(streams, particles):
            drawn = streams.standard_normal(len(mean), particles)
            drawn *= deviation
            drawn += mean
            return drawn

        return signal_strength.model(parameters, draw_prior)


STUDY = Rss3d()
