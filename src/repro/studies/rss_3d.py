"""Tracking by received signal strength in space [energy_harvesting Sec. IV-B, Figs. 11-13]."""

import numpy as np
from pydantic import Field

from repro.models.sensor_network import SensorNetwork
from repro.parameters.values import Positive, Triple
from repro.streams import Streams
from repro.studies import Fields
from repro.studies.families import harvesting_sensors, signal_strength
from repro.studies.families.signal_strength import SignalStrengthParameters, SignalStrengthStudy

STATE = signal_strength.state(3)
State = tuple[float, float, float, float, float, float]
Variances = tuple[Positive, Positive, Positive, Positive, Positive, Positive]


class Parameters(SignalStrengthParameters[Triple, State]):
    """Values of one point. The prior is centred on the true initial state."""

    prior_variances: Variances = Field(
        description="variances of the prior of each component of the state, m^2 and m^2/s^2"
    )


class Rss3d(SignalStrengthStudy):
    """Tracking by received signal strength in space."""

    Parameters = Parameters
    systems_per_block = 20
    trajectory = (("s_x", "s_y"),)
    components = judged_components = signal_strength.components(3)

    def topics(self, parameters: Parameters) -> Fields:
        return harvesting_sensors.topics(STATE, parameters.sensors)

    def model(self, parameters: Parameters) -> SensorNetwork:
        mean = np.array(parameters.true_initial_state)[:, None]
        deviation = np.sqrt(parameters.prior_variances)[:, None]

        def draw_prior(streams: Streams, particles: int) -> np.ndarray:
            drawn = streams.standard_normal(len(mean), particles)
            drawn *= deviation
            drawn += mean
            return drawn

        return signal_strength.model(parameters, draw_prior)


STUDY = Rss3d()
