"""What the filters are in limits of the network, and of many particles: Remarks 3 and 4."""

from types import SimpleNamespace
from typing import Any

import numpy as np

from repro.filters.families import censored_likelihood, protocol_particles
from repro.kernels import arrays
from repro.network.censoring import Censoring, censored
from repro.papers.censored_network.convergence import FILTERS, convergence
from repro.papers.censored_network.time_averages import CENSORING, POINT
from repro.parameters.settings import ProtocolParticles
from repro.streams import Streams
from repro.studies.deadband import STUDY  # that of `saturation` is the same
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim
from repro.verdicts.equivalence import equivalent

CLAIMS: list[Claim] = []


@claim(
    CLAIMS,
    "no-censoring-limit",
    "Remark 3: without censoring (equal thresholds of the dead band, infinite ones of the "
    "saturation) the likelihood is the uncensored one.",
)
def no_censoring_limit(results: Results) -> list[Part]:
    log, analysis = results.log("deadband", POINT), results.analysis("deadband")
    known = STUDY.model(log.parameters)
    tested = slice(analysis.identity_trials)
    streams = Streams(log.seed, "claims", "filter:limits", log.trials[tested].tolist())
    particles = protocol_particles.prior(known, streams, analysis.identity_particles)
    step = STUDY.channels(log, tested).at(1, known.initial_mean)
    parts = []
    for kind, threshold in (("dead band", 0.0), ("saturation", np.inf)):
        limit = known._replace(censoring=Censoring(kind, -threshold, threshold, 0.0))
        received, code = censored(step["received"], limit.censoring)
        seen = SimpleNamespace(**step | {"received": received, "code": code})
        both = [
            arrays.log(censored_likelihood.likelihood(limit, particles, seen, compensated))
            for compensated in (True, False)
        ]
        comparison = f"{kind}: difference of log likelihoods"
        parts.append(below(comparison, _gap(*both), analysis.identity_tolerance))
    return parts


@claim(
    CLAIMS,
    "no-coupling-limit",
    "Remark 3: with a coupling rate of zero MAPF is the filter without coupling.",
)
def no_coupling_limit(results: Results) -> list[Part]:
    log, analysis = results.log("deadband", POINT), results.analysis("deadband")
    known = STUDY.model(log.parameters)._replace(coupling_rate=0.0)
    tested = slice(analysis.identity_trials)
    channels = STUDY.channels(log, tested)
    # The identity does not depend on how particles are resampled and the coupling is drawn.
    settings = ProtocolParticles(
        particles=analysis.identity_particles,
        resampling="systematic",
        coupling_drawn_per="particle",
    )
    estimates = []
    for coupled in (True, False):
        filter_ = protocol_particles.auxiliary(known, settings, coupled=coupled)
        state = filter_.init(
            Streams(log.seed, "claims", "filter:limits", log.trials[tested].tolist())
        )
        for k in range(1, analysis.identity_steps + 1):
            seen: Any = SimpleNamespace(**channels.at(k, filter_.mean(state)))
            state = filter_.step(state, k, seen)
        estimates.append(filter_.mean(state))
    comparison = f"difference of estimates at step {analysis.identity_steps}"
    return [below(comparison, _gap(*estimates), analysis.identity_tolerance)]


def _gap(first: np.ndarray, second: np.ndarray) -> float:
    return float(np.abs(first - second).max())


@claim(
    CLAIMS,
    "convergence-rate",
    "Remark 4: the mean square distance from the limit of many particles falls like 1/D.",
)
def convergence_rate(results: Results) -> list[Part]:
    parts = []
    for study, words in CENSORING.items():
        margin = results.analysis(study).rate_margin
        for filter_ in FILTERS:
            rate, error = convergence(results, study, filter_).rate()
            name = f"{words}, {filter_}: falls like D^-{rate:.2f} ± {error:.2f}, from D^-1"
            parts += equivalent(name, rate - 1.0, error, margin)
    return parts
