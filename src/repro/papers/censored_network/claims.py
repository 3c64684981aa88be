"""Claims of Song et al. (Tables I and II, Figures 2-15, Remark 3)."""

from itertools import product
from types import SimpleNamespace

import numpy as np

from repro.filters.families import censored_likelihood, protocol_particles
from repro.network.censoring import Censoring, censored
from repro.statistics import metrics
from repro.streams import Streams
from repro.studies.families import censored_network as study
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, most

CLAIMS: list[Claim] = []
STUDIES = {"deadband": "dead band", "saturation": "saturation"}
RUNS = 300  # of the paper
SETTINGS = {"particles": 1000, "resampling": "systematic", "coupling_drawn_per": "particle"}
TRIED = 10  # trials on which an identity is tried
AGREEMENT = 3.0  # standard errors of both within which a ratio agrees, as for the values


def averages(results: Results, name: str, point: str, filter_: str):
    """Time-averaged RMSE (targets + average) of all runs, and with one run left out each."""
    of_targets = [
        metrics.roots_over_steps(
            results.each(
                name, point, filter_, lambda runs, i=i: study.squared_distance(runs)[:, 1:, i]
            )
        )
        for i in range(len(study.TARGETS))
    ]
    numbers = [*of_targets, metrics.average(of_targets)]
    return (
        np.array([number.value for number in numbers]),
        np.stack([number.left_out for number in numbers], axis=1),
    )


def difference(results: Results, name: str, first: str, second: str, component=-1, point="base"):
    """The RMSE of `first` is smaller than that of `second` on the same runs."""
    (a, a_left), (b, b_left) = (averages(results, name, point, f) for f in (first, second))
    error = metrics.jackknife_error(a_left - b_left)
    return Part(
        f"{STUDIES[name]}, {study.COMPONENTS[component]}: {first} - {second}",
        float((a - b)[component]),
        float(error[component]),
    )


def ratio(results: Results, name: str, filter_: str) -> tuple[float, float]:
    """Average RMSE of a filter over that of the MAPF, and its jackknife standard error."""
    (a, a_left), (b, b_left) = (averages(results, name, "base", f) for f in (filter_, "mapf"))
    return a[-1] / b[-1], float(metrics.jackknife_error(a_left[:, -1] / b_left[:, -1]))


def agrees(results: Results, name: str, filter_: str, published: float) -> Part:
    """A printed ratio is ours within both Monte Carlo errors."""
    ours, error = ratio(results, name, filter_)
    trials = results.in_shards(name, "base", filter_).trials
    allowed = AGREEMENT * error * np.hypot(1, np.sqrt(trials / RUNS))
    what = f"{STUDIES[name]}: {ours:.3f} ± {error:.3f} against {published}: distance"
    return below(what, abs(ours - published), allowed)


@claim(
    CLAIMS, "C-C1 below DR", "Figs. 2-4, 9-11: the MAPF tracks each target, below dead reckoning"
)
def tracks_better_than_dead_reckoning(results):
    return [
        difference(results, name, "mapf", "dead_reckoning", i)
        for name, i in product(STUDIES, range(len(study.TARGETS)))
    ]


@claim(CLAIMS, "C-C1 bounded", "Figs. 2-4, 9-11: the error of the MAPF stays bounded")
def stays_bounded(results):
    return [
        most(
            f"{STUDIES[name]}: no error of any target above {study.LOST_ABOVE:g} m",
            ~results.each(name, "base", "mapf", study.lost),
        )
        for name in STUDIES
    ]


@claim(CLAIMS, "C-C2 MAPF < NC", "Tables I-II: considering the coupling lowers the average RMSE")
def coupling_considered(results):
    return [difference(results, name, "mapf", "mapf_nc") for name in STUDIES]


@claim(CLAIMS, "C-C2 NC < NMC", "Tables I-II: ignoring censoring costs more than ignoring coupling")
def censoring_matters_more(results):
    return [difference(results, name, "mapf_nc", "mapf_nmc") for name in STUDIES]


@claim(CLAIMS, "C-C2 MAPF < MPF", "Tables I-II: auxiliary below standard resampling on average")
def auxiliary_better(results):
    return [difference(results, name, "mapf", "mpf") for name in STUDIES]


@claim(CLAIMS, "C-C3", "Figs. 6-8, 13-15: the MAPF is the best for every target")
def best_for_every_target(results):
    return [
        difference(results, name, "mapf", other, i)
        for name, other, i in product(
            STUDIES, ("mapf_nc", "mapf_nmc", "mpf"), range(len(study.TARGETS))
        )
    ]


@claim(CLAIMS, "C-C4", "Tables I-II: NC is 1.152 and 1.242 times the MAPF")
def price_of_ignoring_the_coupling(results):
    return [
        agrees(results, "deadband", "mapf_nc", 1.152),
        agrees(results, "saturation", "mapf_nc", 1.242),
    ]


@claim(CLAIMS, "C-C5 ratios", "Tables I-II: NMC is 1.608 and 5.841 times the MAPF")
def price_of_ignoring_the_censoring(results):
    return [
        agrees(results, "deadband", "mapf_nmc", 1.608),
        agrees(results, "saturation", "mapf_nmc", 5.841),
    ]


@claim(CLAIMS, "C-C5 order", "Tables I-II: ignoring saturation costs far more than the dead band")
def saturation_costs_more(results):
    (first, a), (second, b) = (ratio(results, name, "mapf_nmc") for name in STUDIES)
    what = "NMC/MAPF: twice that of the dead band - that of saturation"
    return [Part(what, 2 * first - second, float(np.hypot(2 * a, b)))]


@claim(CLAIMS, "C-C6", "Tables I-II: MPF is 1.018 and 1.053 times the MAPF")
def price_of_standard_resampling(results):
    return [
        agrees(results, "deadband", "mpf", 1.018),
        agrees(results, "saturation", "mpf", 1.053),
    ]


@claim(CLAIMS, "C-C7", "Tables I-II: saturation below dead band for MAPF, NC, MPF; above for NMC")
def saturation_against_dead_band(results):
    parts = []
    for filter_, sign in (("mapf", 1), ("mapf_nc", 1), ("mpf", 1), ("mapf_nmc", -1)):
        (a, a_left), (b, b_left) = (averages(results, name, "base", filter_) for name in STUDIES)
        error = np.hypot(*(metrics.jackknife_error(left[:, -1]) for left in (a_left, b_left)))
        what = "saturation - dead band" if sign > 0 else "dead band - saturation"
        parts.append(Part(f"{filter_}: {what}", float(sign * (b - a)[-1]), float(error)))
    return parts


@claim(CLAIMS, "C-C8 censoring", "Remark 3: y_l = y_r in (4), or infinite in (5), censor nothing")
def limits_of_the_censoring(results):
    log = results.log("deadband", "base")
    known = study.model(log.parameters)
    particles = protocol_particles.Draws(known, 1000, True, "particle").initial(
        Streams(log.seed, "claims", "filter:limits", log.trials[:TRIED].tolist())
    )
    step = study.channels(log, slice(TRIED), log.parameters).at(1, None)
    parts = []
    for kind, threshold in (("dead band", 0.0), ("saturation", 1e9)):
        limit = known._replace(censoring=Censoring(kind, -threshold, threshold, 0.0))
        received, code = censored(step["received"], limit.censoring)
        seen = SimpleNamespace(**step | {"received": received, "code": code})
        both = [
            censored_likelihood.build(limit, flag)(particles, seen, 1) for flag in (True, False)
        ]
        parts.append(below(f"{kind}: difference of log likelihoods", _gap(*both), 1e-12))
    return parts


@claim(CLAIMS, "C-C8 coupling", "Remark 3: alphabar = 0 gives the filter without coupling")
def limit_of_the_coupling(results):
    log = results.log("deadband", "base")
    known = study.model(log.parameters)._replace(coupling_rate=0.0)
    loop = study.channels(log, slice(TRIED), log.parameters)
    estimates = []
    for coupled in (True, False):
        filter_ = protocol_particles.auxiliary(known, SETTINGS, coupled=coupled)
        state = filter_.init(
            Streams(log.seed, "claims", "filter:limits", log.trials[:TRIED].tolist())
        )
        for k in range(1, 6):
            state = filter_.step(state, k, SimpleNamespace(**loop.at(k, None)))
        estimates.append(filter_.mean(state))
    return [below("difference of estimates after five steps", _gap(*estimates), 1e-12)]


def _gap(first: np.ndarray, second: np.ndarray) -> float:
    return float(np.abs(first - second).max())
