"""Tracking by received signal strength in the plane [energy_harvesting Sec. IV-B, Figs. 3-10]."""

import numpy as np
from pydantic import Field

from repro.kernels import arrays
from repro.models.sensor_network import SensorNetwork
from repro.parameters.values import Pair, Positive
from repro.streams import Streams
from repro.studies import Fields
from repro.studies.families import harvesting_sensors, signal_strength
from repro.studies.families.harvesting_sensors import ExactnessAnalysis
from repro.studies.families.signal_strength import (
    SignalStrengthAnalysis,
    SignalStrengthParameters,
    SignalStrengthStudy,
)

STATE = signal_strength.state(2)
State = tuple[float, float, float, float]


class Parameters(SignalStrengthParameters[Pair, State]):
    """Values of one point. The prior is centred on the true initial state."""

    prior_position_variance: Positive = Field(
        description="variance of the prior's position on each axis, m^2"
    )
    prior_speed_variance: Positive = Field(description="variance of the prior's speed, m^2/s^2")
    prior_azimuth_variance: Positive = Field(description="variance of the prior's course, rad^2")


class Analysis(SignalStrengthAnalysis, ExactnessAnalysis):
    """What counts as lost and as equal, and what the figures show."""

    shown_sensor: int = Field(ge=1, description="sensor that Figs. 4 and 5 show, from 1")
    printed_trials: int = Field(ge=1, description="number of trials in the paper")


class Rss2d(SignalStrengthStudy):
    """Tracking by received signal strength in the plane."""

    Parameters = Parameters
    Analysis = Analysis
    systems_per_block = 40
    trajectory = (("s_x", "s_y"),)
    components = judged_components = signal_strength.components(2)

    def topics(self, parameters: Parameters) -> Fields:
        return harvesting_sensors.topics(STATE, parameters.sensors)

    def model(self, parameters: Parameters) -> SensorNetwork:
        x, v_x, y, v_y = parameters.true_initial_state
        speed, azimuth = arrays.hypot(v_x, v_y), arrays.arctan2(v_y, v_x)

        def draw_prior(streams: Streams, particles: int) -> np.ndarray:
            drawn = streams.standard_normal(4, particles)
            speeds = speed + np.sqrt(parameters.prior_speed_variance) * drawn[:, 1]
            azimuths = azimuth + np.sqrt(parameters.prior_azimuth_variance) * drawn[:, 3]
            deviation = np.sqrt(parameters.prior_position_variance)
            drawn[:, 0] = x + deviation * drawn[:, 0]
            drawn[:, 2] = y + deviation * drawn[:, 2]
            drawn[:, 1] = speeds * arrays.cos(azimuths)
            drawn[:, 3] = speeds * arrays.sin(azimuths)
            return drawn

        return signal_strength.model(parameters, draw_prior)


STUDY = Rss2d()
