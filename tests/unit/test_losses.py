import numpy as np
import pytest

from repro.network.losses import Losses, arrivals, bernoulli, log_odds, losses, markov
from tests.conftest import points


def test_losses_nest_over_p():
    """One uniform a step: what is lost at a small p is lost at a larger one."""
    uniforms = np.random.default_rng(0).random((20, 500))
    few, many = (arrivals(uniforms, bernoulli(p)) for p in (0.2, 0.6))
    assert (few >= many).all()
    assert few.mean() == pytest.approx(0.8, abs=0.02)


def test_markov_chain_has_its_transition_probabilities():
    p, q = 0.1, 0.3
    gamma = arrivals(np.random.default_rng(1).random((400, 400)), markov(p, q))
    before, after = gamma[:, :-1], gamma[:, 1:]
    assert gamma[:, 0].mean() == pytest.approx(q / (p + q), abs=0.07)
    assert gamma.mean() == pytest.approx(q / (p + q), abs=0.01)
    assert after[before == 0].mean() == pytest.approx(q, abs=0.01)
    assert after[before == 1].mean() == pytest.approx(1 - p, abs=0.01)


def test_markov_chain_without_memory_is_bernoulli():
    """1 - q = p: the rows of the transition matrix are equal (theta = q)."""
    uniforms = np.random.default_rng(2).random((5, 100))
    np.testing.assert_array_equal(
        arrivals(uniforms, markov(0.3, 0.7)), arrivals(uniforms, bernoulli(0.3))
    )


def test_parameters_choose_the_chain():
    parameters = points()["radar"]["loss=0.3"].parameters
    assert losses(parameters) == bernoulli(0.3)
    changed = parameters.model_copy(update={"loss_process": "Markov", "loss_after_arrival": 0.2})
    assert losses(changed) == markov(0.2, parameters.arrival_after_loss)


def test_certainties_have_infinite_odds():
    np.testing.assert_array_equal(log_odds(np.array([0.0, 0.5, 1.0])), [-np.inf, 0.0, np.inf])
    assert bernoulli(0.0) == Losses(1.0, 1.0, 1.0)
