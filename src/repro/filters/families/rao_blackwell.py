"""Rao-Blackwellised particle filter over loss sequences [unknown_losses Algorithms 3, 4].

A particle is a loss sequence; given it, the state has a Kalman filter. The Kalman filters are the
columns of a bank: a column a particle in Algorithm 3, a column a distinct triple in Algorithm 4.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import kalman
from repro.kernels import rao_blackwell_step as kernels
from repro.kernels.resampling import SCHEMES
from repro.models import Model
from repro.network.channels import Seen
from repro.parameters.settings import RaoBlackwell
from repro.streams import Streams


class Bank(NamedTuple):
    """Kalman filters side by side, in the order of their trials."""

    estimate: np.ndarray  # (n, columns)
    covariance: np.ndarray  # packed, (n (n + 1) / 2, columns)
    first: np.ndarray  # where the columns of each trial begin, and end, (trials + 1,)

    def of_columns(self, values: np.ndarray) -> np.ndarray:
        """Values (trials, m) of each column's trial, (columns, m), component-major in memory."""
        found = np.empty((values.shape[1], self.estimate.shape[1]))
        kernels.of_columns(np.ascontiguousarray(values, dtype=float), self.first, found)
        return found.T


class Particles(NamedTuple):
    """The triples (gamma, xh, Sigma) of all particles: gamma, and where xh and Sigma are."""

    gamma: np.ndarray  # gamma(k) of each, (trials, particles)
    column: np.ndarray  # of the bank, (trials, particles)


class Selection(NamedTuple):
    """What step 3 chose."""

    parents: np.ndarray  # of each particle, in its own trial, (trials, particles)
    resampled: np.ndarray  # in which trials they are not the particles themselves, (trials,)


# Steps 3c and 4a: (bank, innovation, particles, selection) -> those at k|k; may overwrite them.
Update = Callable[[Bank, kalman.Innovation, Particles, Selection], tuple[Bank, Particles]]


class State(NamedTuple):
    """What the filter keeps of step k."""

    keys: np.ndarray  # of the trials' random numbers, (trials,)
    started: bool  # whether there was a packet
    bank: Bank  # at k|k
    particles: Particles
    log_weights: np.ndarray  # (trials, particles), up to a constant of the trial
    weights: np.ndarray  # the same, normalised
    mean: np.ndarray  # xh(k|k), (trials, n)
    degenerate: np.ndarray  # updates so far that left no particle a weight, (trials,)


def build(model: Model, settings: RaoBlackwell, update: Update) -> Filter:
    """The filter, with `column_per_particle` (Algorithm 3) or `column_per_triple` (Algorithm 4).

    Settings: `particles`, N; `threshold`, N_T as a share of N; `resampling`; `proposal`, the prior
    or the optimal one, p(gamma(k) | gamma(k-1), y(k)); `covariance`, with the spread of the means
    or as printed in (17).
    """
    m, count, chain = len(model.measurement_covariance), settings.particles, model.network
    own = update is column_per_particle
    of_noise, optimal = kalman.noise_log_likelihood(model), settings.proposal == "optimal"
    at_first, later = (  # Pr(gamma(k) = 1) after a loss, after an arrival
        tuple(float(chain.arrival(last)) for last in lasts) for lasts in ((None, None), (0.0, 1.0))
    )
    selecting = float(settings.threshold * count), SCHEMES[settings.resampling]
    spread = settings.covariance == "with spread"
    rows, drawn = np.empty((2, count)), np.empty(2 * count + 4)
    of_pairs = np.empty((3, count))

    def init(streams: Streams) -> State:
        """Step 1, without its gamma(0), which is drawn as that of any step."""
        trials = len(streams)
        each = count if own else 1
        first = each * np.arange(trials + 1)
        places = np.arange(count) if own else np.zeros(count, dtype=np.int64)
        return State(
            streams.keys(),
            False,
            Bank(*kalman.start(model, trials * each), first),
            Particles(np.zeros((trials, count)), first[:-1, None] + places),
            log_weights=np.zeros((trials, count)),
            weights=np.full((trials, count), 1 / count),
            mean=np.tile(np.asarray(model.initial_mean, dtype=float), (trials, 1)),
            degenerate=np.zeros(trials),
        )

    def predict(bank: Bank, k: int, seen: Seen) -> Bank:
        """Step 4c of k - 1, (5), of every column; at k = 0 the bank is the prediction already."""
        if k == 0:
            return Bank(bank.estimate.copy(), bank.covariance.copy(), bank.first)
        known = None if seen.input is None else bank.of_columns(seen.input)
        return Bank(
            *kalman.predict(model, bank.estimate, bank.covariance, k - 1, known), bank.first
        )

    def step(state: State, k: int, seen: Seen) -> State:
        """Steps 2 to 4 with y(k), after the prediction that step 4c of k - 1 left to do."""
        bank = predict(state.bank, k, seen)
        received = seen.received.reshape(-1, m)
        innovation = kalman.innovate(
            model, bank.estimate, bank.covariance, bank.of_columns(received)
        )
        gamma, column = state.particles
        log_weights, weights = np.empty_like(gamma), np.empty_like(gamma)
        degenerate = state.degenerate.copy()
        particles = Particles(np.empty_like(gamma), column if own else column.copy())
        selection = Selection(np.empty_like(column), np.empty(len(gamma), dtype=np.bool_))
        kernels.sample_and_select(  # steps 2, 3
            state.keys,
            k,
            (later if state.started else at_first, optimal),
            selecting,
            (innovation.log_likelihood, of_noise(received), bank.first, own, column),
            (gamma, state.log_weights),
            (particles.gamma, log_weights, weights, *selection, degenerate),
            rows[0],
            drawn,
        )
        bank, particles = update(bank, innovation, particles, selection)
        mean = np.empty_like(state.mean)
        kernels.means(
            bank.estimate, bank.first, own, particles.column, weights, mean, rows[0]
        )  # (16), step 4b
        return State(state.keys, True, bank, particles, log_weights, weights, mean, degenerate)

    def variance(state: State) -> np.ndarray:
        """Diagonal of (17), with the spread of the means if the settings say so."""
        (estimate, covariance, first), column = state.bank, state.particles.column
        found = np.empty_like(state.mean)
        known = estimate, covariance, state.mean, spread, first, own, column, state.weights
        kernels.variances(*known, found, rows)
        return found

    def covariance(state: State, components: Sequence[int]) -> np.ndarray:
        """Of some components, likewise."""
        (estimate, covariance, first), column = state.bank, state.particles.column
        found = np.empty((len(state.mean), len(components), len(components)))
        known = estimate, covariance, state.mean, spread, first, own, column, state.weights
        kernels.covariances(*known, np.array(components), found, of_pairs)
        return found

    return Filter(
        init,
        step,
        mean=lambda state: state.mean,
        variance=variance,
        degenerate=lambda state: state.degenerate,
        arrived=lambda state: (state.weights * state.particles.gamma).sum(axis=-1),
        covariance=covariance,
        particles=count,
    )


def column_per_particle(
    bank: Bank, innovation: kalman.Innovation, particles: Particles, selection: Selection
) -> tuple[Bank, Particles]:
    """Algorithm 3; step 4a before 3c: a particle's update depends on its triple alone."""
    gamma = particles.gamma
    kalman.correct(bank.estimate, bank.covariance, innovation, gamma.ravel())  # (4)
    parents, resampled = selection
    row = np.empty(gamma.shape[1])
    kernels.take_parents(resampled, parents, bank.estimate, bank.covariance, gamma, row)
    return bank, particles


def column_per_triple(
    bank: Bank, innovation: kalman.Innovation, particles: Particles, selection: Selection
) -> tuple[Bank, Particles]:
    """Algorithm 4: a column a distinct triple; the results are Algorithm 3's to the last bit."""
    parents, (gamma, column) = selection.parents, particles
    count = gamma.shape[1]
    source, arrived = np.empty(gamma.size, dtype=np.int64), np.empty(gamma.size)
    first = np.zeros_like(bank.first)
    scratch = np.empty(count, dtype=np.int64), np.empty(2 * count, dtype=np.int64)
    total = kernels.distinct(
        parents, bank.first, column, gamma, source, arrived, first, *scratch
    )  # steps 3c and a)

    def taken(values: np.ndarray) -> np.ndarray:
        return values.take(source[:total], axis=-1)

    bank = Bank(taken(bank.estimate), taken(bank.covariance), first)
    innovation = kalman.Innovation(*map(taken, innovation))
    kalman.correct(bank.estimate, bank.covariance, innovation, arrived[:total])  # step b), (4)
    return bank, particles  # step c): their columns are numbered anew


def triples(state: State) -> dict[str, np.ndarray]:
    """Number of distinct triples, (trials,)."""
    return {"triples": np.diff(state.bank.first).astype(float)}
