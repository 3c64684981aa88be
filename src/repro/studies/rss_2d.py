"""Tracking by received signal strength in the plane (Song et al., Sec. IV-B; Figures 3-10)."""

from typing import Annotated

import numpy as np
from pydantic import Field

from repro.models.sensor_network import SensorNetwork
from repro.parameters.values import Pair, Positive
from repro.studies import Fields
from repro.studies.families import harvesting_sensors, signal_strength
from repro.studies.families.signal_strength import SignalStrengthParameters, SignalStrengthStudy

STATE = signal_strength.state(2)


class Parameters(SignalStrengthParameters):
    """Values of one point."""

    sensor_positions: Annotated[tuple[Pair, ...], Field(min_length=1)]
    true_initial_state: tuple[float, float, float, float]
    prior_position_variance: Positive
    prior_speed_variance: Positive
    prior_azimuth_variance: Positive


class Rss2d(SignalStrengthStudy):
    """Tracking by received signal strength in the plane."""

    Parameters = Parameters
    systems_per_block = 40
    trajectory = (("s_x", "s_y"),)
    components = signal_strength.components(2)

    def topics(self, parameters: Parameters) -> Fields:
        return harvesting_sensors.topics(STATE, parameters.sensors)

    def model(self, parameters: Parameters) -> SensorNetwork:
        x, v_x, y, v_y = parameters.true_initial_state
        speed, azimuth = np.hypot(v_x, v_y), np.arctan2(v_y, v_x)

        def draw_prior(streams, particles):
            drawn = streams.standard_normal(4, particles)
            speeds = speed + np.sqrt(parameters.prior_speed_variance) * drawn[:, 1]
            azimuths = azimuth + np.sqrt(parameters.prior_azimuth_variance) * drawn[:, 3]
            deviation = np.sqrt(parameters.prior_position_variance)
            drawn[:, 0] = x + deviation * drawn[:, 0]
            drawn[:, 2] = y + deviation * drawn[:, 2]
            drawn[:, 1] = speeds * np.cos(azimuths)
            drawn[:, 3] = speeds * np.sin(azimuths)
            return drawn

        return signal_strength.model(parameters, draw_prior)


STUDY = Rss2d()
