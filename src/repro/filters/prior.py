"""No measurement: the prior carried on by the model, the line that every filter must beat."""

from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import ross_eh
from repro.kernels import sensed_plants as plants
from repro.models import LinearModel, Model
from repro.models.sensor_network import SensorNetwork
from repro.models.ungm import Growth
from repro.network.channels import Seen
from repro.streams import Streams

LABEL = "no data"
SEES = ()
PARTICLES = 1000  # of the clouds that carry a law which is not Gaussian


def build(model: LinearModel | Model | SensorNetwork, settings: dict) -> Filter:
    """The mean of the prior moves by the model; of a sensor network, a cloud of particles does."""
    if isinstance(model, SensorNetwork):
        return _cloud(model)
    if isinstance(model, LinearModel):

        def moved(mean: np.ndarray, k: int) -> np.ndarray:
            return (model.transition_matrix(k) * mean[:, None]).sum(axis=-1)

    else:

        def moved(mean: np.ndarray, k: int) -> np.ndarray:
            return model.transition(mean, k)

    return Filter(
        init=lambda streams: np.tile(model.initial_mean, (len(streams), 1)),
        step=lambda mean, k, seen: moved(mean, k - 1) if k > 0 else mean,
        mean=lambda mean: mean,
        predicted=lambda mean, k: moved(mean, k - 1) if k > 0 else mean,
    )


class Cloud(NamedTuple):
    """Particles of equal weights."""

    particles: np.ndarray  # (trials, n, particles)
    mean: np.ndarray  # (trials, n)
    keys: np.ndarray  # of the trials' random numbers, (trials,)


def _cloud(model: SensorNetwork) -> Filter:
    plant, drawn = ross_eh.plant_at(model.plant), ross_eh.drawn(model, PARTICLES)[1]
    kernel = plants.growth if isinstance(model.plant, Growth) else plants.target

    def init(streams: Streams) -> Cloud:
        particles = model.draw_prior(streams, PARTICLES)
        return Cloud(particles.copy(), particles.mean(axis=-1), streams.keys())

    def step(cloud: Cloud, k: int, seen: Seen) -> Cloud:
        after = Cloud(cloud.particles.copy(), np.empty_like(cloud.mean), cloud.keys)
        kernel(cloud.keys, k, *plant(k)[:2], after.particles, after.mean, drawn)
        return after

    return Filter(init, step, mean=lambda cloud: cloud.mean)
