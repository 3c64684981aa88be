"""Rao-Blackwellised particle filter over loss sequences (Zhang, You, Xie 2018, Algorithms 3, 4).

A particle is a loss sequence; given it, the state has a Kalman filter. The Kalman filters stand in
a bank of columns: a column a particle in Algorithm 3, a column a distinct triple in Algorithm 4.
"""

from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import kalman
from repro.kernels.resampling import effective_sample_size, multinomial, normalised, systematic
from repro.models import Model
from repro.network.losses import log_odds
from repro.parameters.settings import RaoBlackwell

NUMBERS_A_DRAW = 2048  # of a trial, at once, for as many steps as they are enough for


class Bank(NamedTuple):
    """Kalman filters side by side, in the order of their trials."""

    estimate: np.ndarray  # (n, columns)
    covariance: np.ndarray  # packed, (n (n + 1) / 2, columns)
    trial: np.ndarray  # which trial a column belongs to, (columns,)


class State(NamedTuple):
    draws: "Draws"
    bank: Bank  # at k|k
    column: np.ndarray  # of each particle, (trials, particles)
    gamma: np.ndarray | None  # gamma(k) of each particle; None before the first packet
    log_weights: np.ndarray  # (trials, particles), up to a constant of the trial
    weights: np.ndarray  # the same, normalised
    mean: np.ndarray  # xh(k|k), (n, trials)
    degenerate: np.ndarray  # updates so far that left no particle a weight, (trials,)


class Draws:
    """Two uniforms a particle and step, for gamma and for resampling, drawn some steps ahead."""

    def __init__(self, streams, particles: int):
        self._streams, self._left = streams, 0
        self._shape = (max(1, NUMBERS_A_DRAW // (2 * particles)), 2, particles)

    def next(self) -> tuple[np.ndarray, np.ndarray]:
        """The uniforms of the next step, (trials, particles) each."""
        if self._left == 0:
            self._ahead = self._streams.uniform(*self._shape)
            self._left = self._shape[0]
        step = self._ahead[:, -self._left]
        self._left -= 1
        return step[:, 0], step[:, 1]


def build(model: Model, settings: RaoBlackwell, distinct: bool) -> Filter:
    """`distinct` is Algorithm 4; its results are those of Algorithm 3 to the last bit.

    Settings: `particles`; `threshold`, N_T as a share of N; `resampling` (multinomial, systematic);
    `proposal` (prior, or optimal: p(gamma(k) | gamma(k-1), y(k))); `covariance` (with spread of the
    means, or as printed in (17)).
    """
    n, m, chain = len(model.initial_mean), len(model.measurement_covariance), model.network
    particles, threshold = settings.particles, settings.threshold * settings.particles
    optimal, spread = settings.proposal == "optimal", settings.covariance == "with spread"
    of_noise = kalman.noise_log_likelihood(model)

    def init(streams):
        trials = len(streams)
        columns = 1 if distinct else particles
        bank = Bank(*kalman.start(model, trials * columns), np.arange(trials).repeat(columns))
        column = np.arange(trials * columns).reshape(trials, columns)
        return State(
            Draws(streams, particles),
            bank,
            np.broadcast_to(column, (trials, particles)),
            None,
            np.zeros((trials, particles)),
            np.full((trials, particles), 1 / particles),
            np.repeat(model.initial_mean[:, None], trials, axis=1),
            np.zeros(trials),
        )

    def of_particles(values, column):
        if distinct:
            return values.take(column, axis=-1)
        return values.reshape(*values.shape[:-1], *column.shape)

    def sample(state, uniforms, likelihood, noise):
        """gamma(k) of each particle, and what its log weight gains (step 2)."""
        arrival = chain.arrival(state.gamma)
        if not optimal:
            gamma = uniforms >= 1 - arrival
            return gamma, np.where(gamma, likelihood, noise.repeat(particles, axis=1))
        odds = likelihood - noise + log_odds(arrival)
        gamma = np.log(uniforms) - np.log1p(-uniforms) >= -odds
        with np.errstate(divide="ignore"):
            both = np.log(arrival) + likelihood, np.log1p(-np.asarray(arrival)) + noise
        return gamma, np.logaddexp(*both)

    def resample(weights, uniforms):
        """Parents where too few particles are effective; elsewhere everyone's own (step 3)."""
        rows = np.flatnonzero(effective_sample_size(weights) < threshold)
        if len(rows) == 0:
            return rows, None
        if settings.resampling == "multinomial":
            chosen = multinomial(weights[rows], uniforms[rows])
        else:
            chosen = systematic(weights[rows], uniforms[rows, 0])
        parents = np.broadcast_to(np.arange(particles), weights.shape).copy()
        parents[rows] = chosen
        return rows, parents + np.arange(0, weights.size, particles)[:, None]

    def step(state, k, seen):
        bank = state.bank
        if k > 0:
            known = None if seen.input is None else seen.input.take(bank.trial, axis=0)
            predicted = kalman.predict(model, bank.estimate, bank.covariance, k - 1, known)
            bank = Bank(*predicted, bank.trial)  # step 4c
        received = seen.received.reshape(-1, m)
        of_columns = received.T.take(bank.trial, axis=1).T
        innovation = kalman.innovate(model, bank.estimate, bank.covariance, of_columns)
        likelihood = of_particles(kalman.log_likelihood(innovation), state.column)
        noise = of_noise(received)[:, None]
        for_gamma, for_parents = state.draws.next()
        gamma, gained = sample(state, for_gamma, likelihood, noise)
        log_weights = state.log_weights + gained
        weights, degenerate = normalised(log_weights)
        log_weights[degenerate] = 0.0
        rows, parents = resample(weights, for_parents)
        if parents is not None:
            log_weights[rows], weights[rows] = 0.0, 1 / particles
        update = of_distinct if distinct else of_each
        bank, column, gamma = update(bank, innovation, state.column, gamma, parents)
        return State(
            state.draws,
            bank,
            column,
            gamma,
            log_weights,
            weights,
            combined(bank.estimate, column, weights),
            state.degenerate + degenerate,
        )

    def of_each(bank, innovation, column, gamma, parents):
        """Step 4a: an update a particle. It may as well stand before the particles are chosen."""
        corrected = kalman.correct(
            bank.estimate, bank.covariance, innovation, gamma.ravel().astype(float)
        )
        if parents is None:
            return Bank(*corrected, bank.trial), column, gamma
        corrected = (values.take(parents.ravel(), axis=1) for values in corrected)
        return Bank(*corrected, bank.trial), column, gamma.ravel()[parents]

    def of_distinct(bank, innovation, column, gamma, parents):
        """Steps a) to c) of Algorithm 4: an update a triple, which is a column and a gamma."""
        triple = 2 * column + gamma
        if parents is not None:
            triple = triple.ravel()[parents]
        present = np.zeros(2 * len(bank.trial), dtype=bool)
        present[triple] = True
        kept = np.flatnonzero(present)
        bank = Bank(*(values.take(kept >> 1, axis=-1) for values in bank))
        innovation = kalman.Innovation(*(v.take(kept >> 1, axis=-1) for v in innovation))
        corrected = kalman.correct(
            bank.estimate, bank.covariance, innovation, (kept & 1).astype(float)
        )
        return Bank(*corrected, bank.trial), (np.cumsum(present) - 1).take(triple), triple & 1

    def combined(values, column, weights):
        return np.vecdot(of_particles(values, column), weights)  # (16)

    def variance(state):
        variances = kalman.diagonal(state.bank.covariance, n)
        if spread:
            centre = state.mean.take(state.bank.trial, axis=1)
            variances = variances + (state.bank.estimate - centre) ** 2
        return combined(variances, state.column, state.weights).T  # (17)

    def diagnostics(state):
        counts = np.bincount(state.bank.trial, minlength=len(state.weights))
        return {"triples": counts.astype(float)}

    return Filter(
        init,
        step,
        mean=lambda state: state.mean.T,
        variance=variance,
        degenerate=lambda state: state.degenerate,
        diagnostics=diagnostics if distinct else None,
        arrived=lambda state: np.vecdot(state.weights, state.gamma),
        particles=particles,
    )
