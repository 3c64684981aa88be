"""No measurement: the prior carried on by the model, the line that every filter must beat."""

import numpy as np

from repro.filters import Filter
from repro.models import LinearModel, Model
from repro.models.sensor_network import SensorNetwork

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


def _cloud(model: SensorNetwork) -> Filter:
    def step(state, k, seen):
        particles, streams = state
        return model.move(particles, k, streams), streams

    return Filter(
        init=lambda streams: (model.draw_prior(streams, PARTICLES), streams),
        step=step,
        mean=lambda state: state[0].mean(axis=-1),
        particles=PARTICLES,
    )
