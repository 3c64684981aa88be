"""The scalar example with Gamma and exponential noises [energy_harvesting Sec. IV-A]."""

from types import MappingProxyType
from typing import Annotated

import numpy as np
from pydantic import Field

from repro.models import ungm
from repro.models.sensor_network import ExponentialNoise, SensorNetwork
from repro.parameters.values import Positive
from repro.streams import Streams
from repro.studies import Fields, StreamsOf
from repro.studies.families import harvesting_sensors
from repro.studies.families.harvesting_sensors import (
    ExactnessAnalysis,
    HarvestingParameters,
    HarvestingStudy,
)


class Parameters(HarvestingParameters):
    """Values of one point. State and measurements have no unit."""

    sensor_offsets: Annotated[tuple[float, ...], Field(min_length=1)] = Field(
        description="s_i of each sensor, no unit"
    )
    process_noise_scale: Positive = Field(
        description="scale of the process noise, which is Gamma of shape 2, no unit"
    )
    noise_mean: Positive = Field(
        description="mean of the exponential noises nu and n of sensors and channels, no unit"
    )
    true_initial_state: float = Field(description="x(0), no unit")
    prior_mean: float = Field(description="mean of the Gaussian prior of x(0), no unit")
    prior_variance: Positive = Field(description="variance of that prior, no unit")


def noise(parameters: Parameters) -> ExponentialNoise:
    """Noises of the sensors and of their channels."""
    return ExponentialNoise(parameters.noise_mean, len(parameters.sensor_offsets))


class Ungm(HarvestingStudy):
    """The univariate nonstationary growth model."""

    Parameters = Parameters
    Analysis = ExactnessAnalysis
    systems_per_block = 200
    components = judged_components = MappingProxyType({"state": (0,)})

    def topics(self, parameters: Parameters) -> Fields:
        return harvesting_sensors.topics(("x",), len(parameters.sensor_offsets))

    def simulate(self, parameters: Parameters, streams: StreamsOf) -> dict[str, np.ndarray]:
        steps, offsets = parameters.steps, parameters.sensor_offsets
        w = ungm.gamma_noise(streams("process"), parameters.process_noise_scale, steps)
        truth = np.empty((len(w), steps + 1))
        truth[:, 0] = self.first_states(parameters, streams)[..., 0]
        for k in range(steps):
            truth[:, k + 1] = ungm.transition(truth[:, k], k) + w[:, k]  # (1)
        levels = np.stack([ungm.level(truth, offset) for offset in offsets], axis=1)
        return harvesting_sensors.measured(
            truth[:, :, None], levels, parameters, noise(parameters), streams
        )

    def model(self, parameters: Parameters) -> SensorNetwork:
        offsets, mean = parameters.sensor_offsets, parameters.prior_mean
        deviation = np.sqrt(parameters.prior_variance)

        def draw_prior(streams: Streams, particles: int) -> np.ndarray:
            return mean + deviation * streams.standard_normal(1, particles)

        return SensorNetwork(
            initial_mean=np.array([mean]),
            sensors=len(offsets),
            steps=parameters.steps,
            draw_prior=draw_prior,
            plant=ungm.Growth(parameters.process_noise_scale, offsets),
            noise=noise(parameters),
            saturation=harvesting_sensors.saturation_of(parameters),
            energy=harvesting_sensors.queue(parameters),
        )


STUDY = Ungm()
