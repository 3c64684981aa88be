"""Rao-Blackwellised particle filter over loss sequences [unknown_losses Algorithms 3, 4].

A particle is a loss sequence; given it, the state has a Kalman filter. The Kalman filters are the
columns of a bank: a column a particle in Algorithm 3, a column a distinct triple in Algorithm 4.
"""

from abc import ABC, abstractmethod
from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import kalman
from repro.kernels.resampling import effective_sample_size, multinomial, normalised, systematic
from repro.models import Model
from repro.network.channels import Seen
from repro.network.losses import log_odds
from repro.parameters.settings import RaoBlackwell
from repro.streams import Streams

NUMBERS_PER_DRAW = 2048  # of a trial, for as many steps as they suffice for


class Bank(NamedTuple):
    """Kalman filters side by side, in the order of their trials."""

    estimate: np.ndarray  # (n, columns)
    covariance: np.ndarray  # packed, (n (n + 1) / 2, columns)
    trial: np.ndarray  # which trial a column belongs to, (columns,)


class Particles(NamedTuple):
    """The triples (gamma, xh, Sigma) of all particles: gamma, and where xh and Sigma are."""

    gamma: np.ndarray | None  # gamma(k) of each, (trials, particles); None before the first packet
    column: np.ndarray  # of the bank, (trials, particles)


class State(NamedTuple):
    """What the filter keeps of step k."""

    draws: "Draws"
    bank: Bank  # at k|k
    particles: Particles
    log_weights: np.ndarray  # (trials, particles), up to a constant of the trial
    weights: np.ndarray  # the same, normalised
    mean: np.ndarray  # xh(k|k), (n, trials)
    degenerate: np.ndarray  # updates so far that left no particle a weight, (trials,)


class Draws:
    """Two uniforms a particle and step, for gamma and for resampling, drawn some steps ahead."""

    def __init__(self, streams: Streams, particles: int):
        self._streams, self._left = streams, 0
        self._shape = (max(1, NUMBERS_PER_DRAW // (2 * particles)), 2, particles)
        self._ahead = np.empty(0)

    def next(self) -> tuple[np.ndarray, np.ndarray]:
        """The uniforms of the next step, (trials, particles) each."""
        if self._left == 0:
            self._ahead = self._streams.uniform(*self._shape)
            self._left = self._shape[0]
        step = self._ahead[:, -self._left]
        self._left -= 1
        return step[:, 0], step[:, 1]


class RaoBlackwellised(ABC):
    """Algorithm 3, one method a step, but for step 4a, in which Algorithm 4 differs.

    Settings: `particles`, N; `threshold`, N_T as a share of N; `resampling`; `proposal`, the prior
    or the optimal one, p(gamma(k) | gamma(k-1), y(k)); `covariance`, with the spread of the means
    or as printed in (17).
    """

    def __init__(self, model: Model, settings: RaoBlackwell):
        self._model, self._settings = model, settings
        self._n, self._m = len(model.initial_mean), len(model.measurement_covariance)
        self._noise_likelihood = kalman.noise_log_likelihood(model)

    def filter(self) -> Filter:
        """The filter as pure functions of its state."""
        return Filter(
            self.init,
            self.step,
            mean=lambda state: state.mean.T,
            variance=self.variance,
            degenerate=lambda state: state.degenerate,
            arrived=lambda state: np.vecdot(state.weights, state.particles.gamma),
            particles=self._settings.particles,
        )

    def init(self, streams: Streams) -> State:
        """Step 1, without its gamma(0), which `sample` draws as that of any step."""
        trials, particles = len(streams), self._settings.particles
        columns = self._first_columns()
        start = kalman.start(self._model, trials * columns)
        column = np.arange(trials * columns).reshape(trials, columns)
        return State(
            Draws(streams, particles),
            Bank(*start, np.arange(trials).repeat(columns)),
            Particles(None, np.broadcast_to(column, (trials, particles))),
            log_weights=np.zeros((trials, particles)),
            weights=np.full((trials, particles), 1 / particles),
            mean=np.repeat(self._model.initial_mean[:, None], trials, axis=1),
            degenerate=np.zeros(trials),
        )

    def step(self, state: State, k: int, seen: Seen) -> State:
        """Steps 2 to 4 with y(k), after the prediction that step 4c of k - 1 left to do."""
        bank = self.predict(state.bank, k, seen)
        received = seen.received.reshape(-1, self._m)
        of_columns = received.T.take(bank.trial, axis=1).T
        innovation = kalman.innovate(self._model, bank.estimate, bank.covariance, of_columns)
        for_gamma, for_parents = state.draws.next()
        gamma, gained = self.sample(state.particles, for_gamma, innovation, received)
        log_weights = state.log_weights + gained  # step 2b
        weights, degenerate = normalised(log_weights)
        log_weights[degenerate] = 0.0
        rows, parents = self.resample(weights, for_parents)
        if parents is not None:
            log_weights[rows], weights[rows] = 0.0, 1 / self._settings.particles  # step 3c
        sampled = Particles(gamma, state.particles.column)
        bank, particles = self.update(bank, innovation, sampled, parents)
        return State(
            state.draws,
            bank,
            particles,
            log_weights,
            weights,
            self._combined(bank.estimate, particles.column, weights),  # (16), step 4b
            state.degenerate + degenerate,
        )

    def predict(self, bank: Bank, k: int, seen: Seen) -> Bank:
        """Step 4c, (5), of every column; at k = 0 the bank is the prediction already."""
        if k == 0:
            return bank
        known = None if seen.input is None else seen.input.take(bank.trial, axis=0)
        predicted = kalman.predict(self._model, bank.estimate, bank.covariance, k - 1, known)
        return Bank(*predicted, bank.trial)

    def sample(
        self,
        particles: Particles,
        uniforms: np.ndarray,
        innovation: kalman.Innovation,
        received: np.ndarray,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Step 2: gamma(k) of each particle, and what its log weight gains (19)."""
        # log p(y(k) | Y(k-1), Gamma(k)) for gamma(k) = 1 and 0
        likelihood = self._of_particles(kalman.log_likelihood(innovation), particles.column)
        noise = self._noise_likelihood(received)[:, None]
        arrival = self._model.network.arrival(particles.gamma)  # p(gamma(k) = 1 | gamma(k-1))
        if self._settings.proposal == "prior":  # as in the algorithm: the priors in (19) cancel
            gamma = uniforms >= 1 - arrival
            return gamma, np.where(gamma, likelihood, noise.repeat(uniforms.shape[1], axis=1))
        odds = likelihood - noise + log_odds(arrival)
        gamma = np.log(uniforms) - np.log1p(-uniforms) >= -odds
        with np.errstate(divide="ignore"):
            both = np.log(arrival) + likelihood, np.log1p(-np.asarray(arrival)) + noise
        return gamma, np.logaddexp(*both)  # p(y(k) | Y(k-1), Gamma(k-1))

    def resample(
        self, weights: np.ndarray, uniforms: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray | None]:
        """Steps 3a, 3b: the trials with too few effective particles, and the parents in all trials.

        Parents are numbered through all trials, (trials, particles); elsewhere each particle is
        its own. None if no trial resamples.
        """
        particles, settings = weights.shape[1], self._settings
        rows = np.flatnonzero(effective_sample_size(weights) < settings.threshold * particles)
        if len(rows) == 0:
            return rows, None
        if settings.resampling == "multinomial":
            chosen = multinomial(weights[rows], uniforms[rows])
        else:
            chosen = systematic(weights[rows], uniforms[rows, 0])
        parents = np.broadcast_to(np.arange(particles), weights.shape).copy()
        parents[rows] = chosen
        return rows, parents + np.arange(0, weights.size, particles)[:, None]

    @abstractmethod
    def update(
        self,
        bank: Bank,
        innovation: kalman.Innovation,
        particles: Particles,
        parents: np.ndarray | None,
    ) -> tuple[Bank, Particles]:
        """Steps 3c and 4a: the parents' triples take the place of all, and (4) is done for each."""

    def variance(self, state: State) -> np.ndarray:
        """Diagonal of (17), (trials, n), with the spread of the means if the settings say so."""
        variances = kalman.diagonal(state.bank.covariance, self._n)
        if self._settings.covariance == "with spread":
            centre = state.mean.take(state.bank.trial, axis=1)
            variances = variances + (state.bank.estimate - centre) ** 2
        return self._combined(variances, state.particles.column, state.weights).T

    def _combined(self, values: np.ndarray, column: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """Weighted sum over the particles of (n, columns), (n, trials)."""
        return np.vecdot(self._of_particles(values, column), weights)

    @abstractmethod
    def _first_columns(self) -> int:
        """Columns that each trial has before the first packet."""

    @abstractmethod
    def _of_particles(self, values: np.ndarray, column: np.ndarray) -> np.ndarray:
        """Values (..., columns) of each particle, (..., trials, particles)."""


class ColumnPerParticle(RaoBlackwellised):
    """Algorithm 3: the columns are the particles, in their order."""

    def update(
        self,
        bank: Bank,
        innovation: kalman.Innovation,
        particles: Particles,
        parents: np.ndarray | None,
    ) -> tuple[Bank, Particles]:
        """Step 4a before 3c: a particle's update depends on its triple alone."""
        gamma = np.asarray(particles.gamma)
        corrected = kalman.correct(
            bank.estimate, bank.covariance, innovation, gamma.ravel().astype(float)
        )  # (4)
        if parents is not None:
            gamma = gamma.ravel()[parents]
            estimate, covariance = (part.take(parents.ravel(), axis=1) for part in corrected)
            corrected = estimate, covariance
        return Bank(*corrected, bank.trial), particles._replace(gamma=gamma)

    def _first_columns(self) -> int:
        return self._settings.particles

    def _of_particles(self, values: np.ndarray, column: np.ndarray) -> np.ndarray:
        return values.reshape(*values.shape[:-1], *column.shape)


class ColumnPerTriple(RaoBlackwellised):
    """Algorithm 4: a column a distinct triple; the results are Algorithm 3's to the last bit."""

    def filter(self) -> Filter:
        """The same, which also records the number of distinct triples."""
        return super().filter()._replace(diagnostics=self.diagnostics)

    def update(
        self,
        bank: Bank,
        innovation: kalman.Innovation,
        particles: Particles,
        parents: np.ndarray | None,
    ) -> tuple[Bank, Particles]:
        """Step 3c, and steps a) to c) of Algorithm 4."""
        # Particles of one column have equal xh and Sigma: column and gamma number their triples.
        triple = 2 * particles.column + particles.gamma
        if parents is not None:
            triple = triple.ravel()[parents]
        present = np.zeros(2 * len(bank.trial), dtype=bool)
        present[triple] = True
        distinct = np.flatnonzero(present)  # step a), the index set I
        column, gamma = distinct >> 1, distinct & 1
        bank = Bank(*(values.take(column, axis=-1) for values in bank))
        innovation = kalman.Innovation(*(values.take(column, axis=-1) for values in innovation))
        corrected = kalman.correct(
            bank.estimate, bank.covariance, innovation, gamma.astype(float)
        )  # step b), (4)
        place = np.cumsum(present) - 1  # of a triple among the distinct ones
        return Bank(*corrected, bank.trial), Particles(triple & 1, place.take(triple))  # step c)

    def diagnostics(self, state: State) -> dict[str, np.ndarray]:
        """Number of distinct triples, (trials,)."""
        counts = np.bincount(state.bank.trial, minlength=len(state.weights))
        return {"triples": counts.astype(float)}

    def _first_columns(self) -> int:
        return 1

    def _of_particles(self, values: np.ndarray, column: np.ndarray) -> np.ndarray:
        return values.take(column, axis=-1)
