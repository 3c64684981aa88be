"""Numbers that the reasons for the verdicts on censored_network state."""

from collections.abc import Mapping
from functools import partial
from typing import NamedTuple

import numpy as np

from repro.network.censoring import EXACT
from repro.papers.censored_network.convergence import FILTERS
from repro.papers.censored_network.time_averages import (
    CENSORING,
    POINT,
    PUBLISHED,
    first_trials,
    time_average,
)
from repro.statistics import metrics
from repro.studies.families.censored_network import COMPONENTS, STATE, TARGETS, sensors
from repro.tables.results import Results
from repro.verdicts.facts import Fact
from repro.verdicts.published import read_published

EARLY = 10  # step at which the filter that ignores saturation is looked at
MULTINOMIAL = "reading-resampling=multinomial"
IN_PERCENT = 100.0


class Distances(NamedTuple):
    """Distances to the sensors whose readings arrive, k >= 1, (trials, steps, targets, b), in m."""

    true: np.ndarray
    estimated: np.ndarray
    is_censored: np.ndarray


def distances(results: Results, study: str, filter_: str) -> Distances:
    """From the true and from the estimated positions, over all trials."""
    log = results.log(study, POINT)
    truth, error = log.values["/truth"], results.runs(study, POINT, filter_).error
    known = sensors(log.parameters)
    group = np.stack([log.field("/network", f"group_{i}") for i in TARGETS], axis=-1).astype(int)
    readings = range(1, known.shape[1] + 1)
    codes = [[log.field("/received", f"code_{i}_{j}") for j in readings] for i in TARGETS]

    def distance(state: np.ndarray) -> np.ndarray:
        position = state.reshape(*state.shape[:2], len(TARGETS), len(STATE))[..., None, :2]
        return np.linalg.norm(position - known[group - 1], axis=-1)[:, 1:]

    is_censored = np.moveaxis(np.array(codes), (0, 1), (2, 3))[:, 1:] != EXACT
    return Distances(distance(truth), distance(truth + error), is_censored)


def zeros_at_face_value(results: Results) -> Mapping[str, float]:
    """What a dead-band zero stands for, from where it comes, and how it moves an estimate."""
    parameters = results.parameters("deadband", POINT)
    decades = (parameters.strength_at_reference - parameters.dead_band_constant) / (
        10.0 * parameters.path_loss_exponent
    )
    stands_for = parameters.reference_distance * 10.0**decades
    numbers = {"zero_stands_for": float(stands_for)}
    for filter_ in ("mapf", "mapf_nmc"):
        true, estimated, is_zero = distances(results, "deadband", filter_)
        nearer = (true - estimated)[is_zero].mean()
        numbers |= {
            f"zeros_pull_{filter_}": float(nearer),
            "zeros_share": float(IN_PERCENT * is_zero.mean()),
            "zeros_from_farther": float(IN_PERCENT * (true[is_zero] > stands_for).mean()),
        }
    return numbers


def saturation_at_face_value(results: Results) -> Mapping[str, float]:
    """How many readings are saturated, and how far from the sensors the targets are thought."""
    parameters = results.parameters("saturation", POINT)
    decades = (parameters.strength_at_reference - parameters.lower_threshold) / (
        10.0 * parameters.path_loss_exponent
    )
    true, estimated, is_censored = distances(results, "saturation", "mapf_nmc")
    return {
        "early_step": EARLY,
        "saturated_stands_for": float(parameters.reference_distance * 10.0**decades),
        "saturated_share": float(IN_PERCENT * is_censored.mean()),
        "early_distance": float(np.median(true[:, EARLY - 1])),
        "early_distance_mapf_nmc": float(np.median(estimated[:, EARLY - 1])),
    }


def cost_of_ignoring_coupling(results: Results) -> Mapping[str, float]:
    """NC/MAPF of the average over all steps and over the first of them."""
    horizon = results.analysis("deadband").short_horizon
    over_first = partial(time_average, steps=slice(1, horizon + 1))
    numbers = {"short_horizon": float(horizon)}
    for study in CENSORING:
        for words, average in (("all", time_average), ("first", over_first)):
            nc, mapf = (average(results, study, name).value[-1] for name in ("mapf_nc", "mapf"))
            numbers[f"nc_ratio_{words}_{study}"] = float(nc / mapf)
    return numbers


def detectable_differences(results: Results) -> Mapping[str, float]:
    """MAPF - MPF of the averages, and the smallest difference that the runs would decide, in m."""
    rows = read_published(PUBLISHED)
    averages = rows[rows["component"] == COMPONENTS[-1]].set_index(["study", "filter"])
    printed = averages["value"].astype(float)
    numbers = {}
    for study in CENSORING:
        mapf, mpf = (time_average(results, study, name) for name in ("mapf", "mpf"))
        error = metrics.jackknife_error((mapf.left_out - mpf.left_out)[:, -1])
        numbers |= {
            f"mapf_mpf_{study}": float((mapf.value - mpf.value)[-1]),
            f"printed_mapf_mpf_{study}": printed[study, "mapf"] - printed[study, "mpf"],
            f"mapf_mpf_detectable_{study}": float(results.tolerance * error),
        }
    return numbers


def multinomial_resampling(results: Results) -> Mapping[str, float]:
    """Average RMSE with multinomial resampling less that with systematic, paired over runs."""
    numbers = {}
    for study in CENSORING:
        for filter_ in FILTERS:
            trials = results.in_shards(study, MULTINOMIAL, filter_).trials
            drawn = time_average(results, study, filter_, MULTINOMIAL)
            systematic = time_average(results, study, filter_, average=first_trials(trials))
            error = metrics.jackknife_error((drawn.left_out - systematic.left_out)[:, -1])
            numbers |= {
                f"multinomial_{filter_}_{study}": float((drawn.value - systematic.value)[-1]),
                f"multinomial_{filter_}_{study}_error": float(error),
            }
    return numbers


FACTS: list[Fact] = [
    zeros_at_face_value,
    saturation_at_face_value,
    cost_of_ignoring_coupling,
    detectable_differences,
    multinomial_resampling,
]
