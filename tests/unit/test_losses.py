import numpy as np
import pytest

from repro.network.losses import Losses, arrivals, log_odds, losses

BERNOULLI = {"loss_process": "Bernoulli", "loss_probability": 0.3}


def test_losses_nest_over_p():
    """One uniform a step: what is lost at a small p is lost at a larger one."""
    uniforms = np.random.default_rng(0).random((20, 500))
    few, many = (
        arrivals(uniforms, losses(BERNOULLI | {"loss_probability": p})) for p in (0.2, 0.6)
    )
    assert (few >= many).all()
    assert few.mean() == pytest.approx(0.8, abs=0.02)


def test_markov_chain_has_its_transition_probabilities():
    p, q = 0.1, 0.3
    chain = losses({"loss_process": "Markov", "loss_after_arrival": p, "arrival_after_loss": q})
    gamma = arrivals(np.random.default_rng(1).random((400, 400)), chain)
    before, after = gamma[:, :-1], gamma[:, 1:]
    assert gamma[:, 0].mean() == pytest.approx(q / (p + q), abs=0.07)
    assert gamma.mean() == pytest.approx(q / (p + q), abs=0.01)
    assert after[before == 0].mean() == pytest.approx(q, abs=0.01)
    assert after[before == 1].mean() == pytest.approx(1 - p, abs=0.01)


def test_markov_chain_without_memory_is_bernoulli():
    """1 - q = p: the rows of the transition matrix are equal (theta = q)."""
    uniforms = np.random.default_rng(2).random((5, 100))
    markov = losses(
        {"loss_process": "Markov", "loss_after_arrival": 0.3, "arrival_after_loss": 0.7}
    )
    np.testing.assert_array_equal(arrivals(uniforms, markov), arrivals(uniforms, losses(BERNOULLI)))


def test_certainties_have_infinite_odds():
    np.testing.assert_array_equal(log_odds(np.array([0.0, 0.5, 1.0])), [-np.inf, 0.0, np.inf])
    assert losses(BERNOULLI | {"loss_probability": 0.0}) == Losses(1.0, 1.0, 1.0)
