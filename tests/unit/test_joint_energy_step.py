"""The filter on the joint law of battery and harvest, where it must be another."""

import numpy as np
import pytest

from repro import plugins
from repro.filters import pf_ross_eh_joint
from repro.filters.families import ross_eh
from repro.kernels import joint_energy_step
from repro.parameters.settings import JointBootstrap
from repro.runner import run
from repro.simulate import simulated
from repro.streams import Streams
from tests.conftest import SEED, points, small_log

COUNT = 100


@pytest.mark.parametrize("study", ["ungm", "rss_2d"])
@pytest.mark.parametrize("scheme", ["systematic", "multinomial"])
def test_with_full_batteries_it_is_the_filter_of_saturation(study, scheme):
    always = {"harvest_transition": np.tile([0.0, 0.5, 0.3, 0.2], (4, 1)).tolist(), "steps": 20}
    parameters = points()[study]["base"].parameters
    parameters = type(parameters).checked(parameters.plain() | always, "test")
    log = simulated(study, "base", parameters, SEED, np.arange(5))
    settings = {"particles": COUNT, "resampling": scheme}
    joint = run(log, "pf_ross_eh_joint", settings)[0]
    alone = run(log, "pf_ross", settings | {"weights": "logarithmic"})[0]
    np.testing.assert_allclose(joint, alone, rtol=1e-9)


@pytest.mark.parametrize("study", ["ungm", "rss_2d"])
def test_laws_and_weights_are_the_same_in_logarithms(study):
    log = small_log(study, "base")
    model = plugins.study(study).model(log.parameters)
    settings = JointBootstrap(particles=COUNT, resampling="systematic")
    filter_ = pf_ross_eh_joint.build(model, settings)
    streams = Streams(1, study, "filter:bootstrap", log.trials.tolist())
    before = filter_.init(streams)
    _, sensors, pairs, _ = before.laws.shape
    rng = np.random.default_rng(6)
    levels = rng.normal(size=(sensors, COUNT))
    chain = rng.random((pairs, pairs)) * (rng.random((pairs, pairs)) < 0.5)
    chain /= chain.sum(axis=1, keepdims=True)
    energy = chain, np.arange(pairs) < 4
    z = levels[:, :5].T + 0.5
    found = []
    for in_logarithms in (False, True):
        rows = np.empty((sensors + pairs + joint_energy_step.ROWS, COUNT))
        rows[:sensors] = levels
        after = [np.empty_like(part) for part in before[:5]]
        joint_energy_step.update(
            2,
            np.ascontiguousarray(z),
            ross_eh.noises(model),
            ross_eh.network(1.0, model.saturation),
            energy,
            before[:4],
            tuple(after),
            (rng.integers(0, COUNT, COUNT), np.empty(4 * COUNT), rows),
            in_logarithms,
        )
        weights, laws = after[1][2], after[2][2]
        found.append((np.exp(weights) if in_logarithms else weights, laws))
        np.testing.assert_allclose(laws.sum(axis=1), 1.0, rtol=1e-12)
    for linear, logarithmic in zip(*found, strict=True):
        np.testing.assert_allclose(linear, logarithmic, rtol=1e-10, atol=1e-200)
