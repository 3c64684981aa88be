"""Claims of censored_network: Tables I and II, Figures 2-15, Remark 3."""

from itertools import product
from types import SimpleNamespace
from typing import Any

import numpy as np

from repro.filters.families import censored_likelihood, protocol_particles
from repro.kernels import arrays
from repro.network.censoring import Censoring, censored
from repro.papers.censored_network.time_averages import CENSORING, POINT, TimeAverage, time_average
from repro.parameters.settings import ProtocolParticles
from repro.statistics import metrics
from repro.streams import Streams
from repro.studies.deadband import STUDY  # that of `saturation` is the same
from repro.studies.families.censored_network import COMPONENTS, TARGETS
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, most
from repro.verdicts.published import read_published

CLAIMS: list[Claim] = []
PUBLISHED = "params/published/censored_network.csv"
RATIO_DIGITS = 3  # decimals of a ratio of two averages that are printed with four


def published_ratio(study: str, filter_: str) -> tuple[float, int]:
    """Ratio of a filter's published average RMSE to that of MAPF, and the number of runs."""
    rows = read_published(PUBLISHED)
    averages = rows[
        (rows["study"] == study)
        & (rows["point"] == POINT)
        & (rows["metric"] == "rmse")
        & (rows["component"] == "average")
    ].set_index("filter")
    of_filter, of_mapf = (float(averages.at[name, "value"]) for name in (filter_, "mapf"))
    return round(of_filter / of_mapf, RATIO_DIGITS), int(averages.at[filter_, "trials"])


def difference(results: Results, study: str, first: str, second: str, component: int = -1) -> Part:
    """The RMSE of `first` is below that of `second`, paired over the runs."""
    a, b = (time_average(results, study, filter_) for filter_ in (first, second))
    error = metrics.jackknife_error(a.left_out - b.left_out)
    return Part(
        f"{CENSORING[study]}, {COMPONENTS[component]}: {first} - {second}",
        float((a.value - b.value)[component]),
        float(error[component]),
    )


def ratio_to_mapf(results: Results, study: str, filter_: str) -> tuple[float, float]:
    """Average RMSE of a filter over that of MAPF, and its jackknife standard error."""
    a, b = (time_average(results, study, name) for name in (filter_, "mapf"))
    left_out = a.left_out[:, -1] / b.left_out[:, -1]
    return float(a.value[-1] / b.value[-1]), float(metrics.jackknife_error(left_out))


def ratios_as_published(results: Results, filter_: str) -> list[Part]:
    """The ratio of a filter to MAPF is the published one, within both Monte Carlo errors."""
    parts = []
    for study, words in CENSORING.items():
        published, runs = published_ratio(study, filter_)
        ours, error = ratio_to_mapf(results, study, filter_)
        trials = results.in_shards(study, POINT, filter_).trials
        allowed = results.tolerance * error * np.sqrt(1 + trials / runs)
        comparison = f"{words}: {ours:.3f} ± {error:.3f}, published {published}: distance"
        parts.append(below(comparison, abs(ours - published), float(allowed), error))
    return parts


@claim(
    CLAIMS,
    "mapf-below-dead-reckoning",
    "Figs. 2-4, 9-11: MAPF tracks every target with a smaller error than dead reckoning.",
)
def mapf_below_dead_reckoning(results: Results) -> list[Part]:
    return [
        difference(results, study, "mapf", "dead_reckoning", i)
        for study, i in product(CENSORING, range(len(TARGETS)))
    ]


@claim(
    CLAIMS,
    "mapf-error-bounded",
    "Figs. 2-4, 9-11: the error of MAPF stays bounded in most runs.",
)
def mapf_error_bounded(results: Results) -> list[Part]:
    parts = []
    for study, words in CENSORING.items():
        analysis = results.analysis(study)
        lost = results.each(study, POINT, "mapf", lambda runs, a=analysis: STUDY.lost(runs, a))
        parts.append(most(f"{words}: no target's error above {analysis.lost_above:g} m", ~lost))
    return parts


@claim(
    CLAIMS,
    "mapf-below-nc",
    "Tables I-II: MAPF, which models the coupling, has a smaller average RMSE than MAPF-NC.",
)
def mapf_below_nc(results: Results) -> list[Part]:
    return [difference(results, study, "mapf", "mapf_nc") for study in CENSORING]


@claim(
    CLAIMS,
    "nc-below-nmc",
    "Tables I-II: ignoring the censoring costs more than ignoring the coupling.",
)
def nc_below_nmc(results: Results) -> list[Part]:
    return [difference(results, study, "mapf_nc", "mapf_nmc") for study in CENSORING]


@claim(
    CLAIMS,
    "mapf-below-mpf",
    "Tables I-II: auxiliary resampling gives a smaller average RMSE than standard resampling.",
)
def mapf_below_mpf(results: Results) -> list[Part]:
    return [difference(results, study, "mapf", "mpf") for study in CENSORING]


@claim(
    CLAIMS,
    "mapf-best-for-every-target",
    "Figs. 6-8, 13-15: MAPF has the smallest error of the four filters for every target.",
)
def mapf_best_for_every_target(results: Results) -> list[Part]:
    return [
        difference(results, study, "mapf", other, i)
        for study, other, i in product(
            CENSORING, ("mapf_nc", "mapf_nmc", "mpf"), range(len(TARGETS))
        )
    ]


@claim(
    CLAIMS,
    "nc-to-mapf-ratio",
    "Tables I-II: ignoring the coupling raises the average RMSE by the published factors.",
)
def nc_to_mapf_ratio(results: Results) -> list[Part]:
    return ratios_as_published(results, "mapf_nc")


@claim(
    CLAIMS,
    "nmc-to-mapf-ratio",
    "Tables I-II: ignoring the censoring raises the average RMSE by the published factors.",
)
def nmc_to_mapf_ratio(results: Results) -> list[Part]:
    return ratios_as_published(results, "mapf_nmc")


@claim(
    CLAIMS,
    "saturation-costlier-than-dead-band",
    "Tables I-II: ignoring saturation costs far more than ignoring the dead band.",
)
def saturation_costlier_than_dead_band(results: Results) -> list[Part]:
    factor = results.analysis("saturation").far_costlier
    (dead_band, a), (saturation, b) = (
        ratio_to_mapf(results, study, "mapf_nmc") for study in ("deadband", "saturation")
    )
    comparison = f"NMC/MAPF: {factor:g} times that of the dead band - that of saturation"
    return [Part(comparison, factor * dead_band - saturation, _of_both(factor * a, b))]


@claim(
    CLAIMS,
    "mpf-to-mapf-ratio",
    "Tables I-II: standard resampling raises the average RMSE by the published factors.",
)
def mpf_to_mapf_ratio(results: Results) -> list[Part]:
    return ratios_as_published(results, "mpf")


@claim(
    CLAIMS,
    "saturation-below-dead-band",
    "Tables I-II: the average RMSE is smaller under saturation than under the dead band for "
    "MAPF, MAPF-NC and MPF, and larger for MAPF-NMC.",
)
def saturation_below_dead_band(results: Results) -> list[Part]:
    parts = []
    for filter_, sign in (("mapf", 1), ("mapf_nc", 1), ("mpf", 1), ("mapf_nmc", -1)):
        dead_band, saturation = (
            time_average(results, study, filter_) for study in ("deadband", "saturation")
        )
        error = _of_both(_error_of_average(dead_band), _error_of_average(saturation))
        words = "saturation - dead band" if sign > 0 else "dead band - saturation"
        gap = sign * (saturation.value - dead_band.value)[-1]
        parts.append(Part(f"{filter_}: {words}", float(gap), error))
    return parts


def _error_of_average(average: TimeAverage) -> float:
    return float(metrics.jackknife_error(average.left_out[:, -1]))


def _of_both(first: float, second: float) -> float:
    """Standard error of a sum or difference of independent numbers."""
    return float(np.sqrt(first * first + second * second))


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
