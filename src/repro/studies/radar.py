"""Radar tracking with unknown measurement losses (Zhang, You, Xie 2018, Sec. VI-B)."""

import numpy as np

from repro.models import Model, linear_system
from repro.models import radar as system
from repro.models.sparse import rows as sparse_rows
from repro.network import losses
from repro.network.channels import Recorded
from repro.statistics import metrics

TRIALS_A_BLOCK = 8000  # systems, trials times particles: few calls, and their rows stay cached
CLAIMED_VARIANCE = False  # none of the tables has it
TRAJECTORY = (("p1", "p2"),)
LOST_ABOVE = 100.0  # m: a run that ends with a larger error has lost the target


def topics(parameters: dict) -> dict[str, tuple[str, ...]]:
    return {
        "/truth": system.STATE,
        "/sensor": ("range", "bearing"),
        "/received": ("range", "bearing"),
        "/network": ("gamma",),
    }


def period(parameters: dict) -> float:
    return parameters["sampling_time"]


def first_step(parameters: dict) -> int:
    return parameters["first_measurement"]


def _measurement(x: np.ndarray, parameters: dict) -> np.ndarray:
    return system.measurement(x, "arctan" if parameters["bearing"] == "arctan" else "atan2")


def _noise_deviations(parameters: dict) -> np.ndarray:
    return np.array(
        [parameters["range_deviation"], np.deg2rad(parameters["bearing_deviation_deg"])]
    )


def _of_both_axes(along: list[float]) -> np.ndarray:
    return np.tile(np.array(along, dtype=float), 2)


def _covariances(parameters: dict) -> tuple[np.ndarray, np.ndarray]:
    """Q and Sigma_0."""
    period_, deviation = parameters["sampling_time"], parameters["range_deviation"]
    process = system.process_covariance(
        period_, parameters["manoeuvre_rate"], parameters["manoeuvre_deviation"]
    )
    return process, system.initial_covariance(period_, deviation)


def simulate(parameters: dict, streams) -> dict[str, np.ndarray]:
    steps, n = parameters["steps"], len(system.STATE)
    process, prior = _covariances(parameters)
    x0 = np.matvec(linear_system.root(prior), streams("prior").standard_normal(n))
    if parameters["true_initial_state"] == "mean":
        x0[:] = 0.0
    w = np.matvec(linear_system.root(process), streams("process").standard_normal(steps, n))
    truth = linear_system.trajectory(
        sparse_rows(system.transition_matrix(parameters["sampling_time"])),
        _of_both_axes(parameters["true_initial_mean"]) + x0,
        _of_both_axes(parameters["known_input"]) + w,
    )  # (21)
    v = _noise_deviations(parameters) * streams("sensor").standard_normal(steps + 1, 2)
    gamma = losses.arrivals(streams("network").uniform(steps + 1), losses.losses(parameters))
    measured = _measurement(truth, parameters)
    return {
        "/truth": truth,
        "/sensor": measured + v,
        "/received": gamma[:, :, None] * measured + v,
        "/network": gamma[:, :, None],
    }


def model(parameters: dict) -> Model:
    transition = sparse_rows(system.transition_matrix(parameters["sampling_time"]))
    process, prior = _covariances(parameters)
    u = _of_both_axes(parameters["known_input"])
    wrapped = parameters["bearing"] == "atan2, wrapped"
    return Model(
        transition=lambda x, k: linear_system.product(transition, x, u),
        transition_jacobian=lambda x, k: transition,
        measurement=lambda x, sensor: _measurement(x, parameters),
        measurement_jacobian=lambda x, sensor: system.measurement_jacobian(x),
        process_covariance=process,
        measurement_covariance=np.diag(_noise_deviations(parameters) ** 2),
        initial_mean=_of_both_axes(parameters["initial_estimate"]),
        initial_covariance=prior,
        network=losses.losses(parameters),
        innovation=system.wrapped_innovation if wrapped else np.subtract,
    )


def channels(log, trials: slice, parameters: dict) -> Recorded:
    return Recorded(
        received=log.values["/received"][trials],
        arrival=log.field("/network", "gamma")[trials],
    )


def error(log, estimate: np.ndarray) -> np.ndarray:
    return estimate - log.values["/truth"]


def squared_distance(error: np.ndarray) -> np.ndarray:
    """Squared position error of (trials, steps, 6), in m^2."""
    return error[:, :, 0] ** 2 + error[:, :, 3] ** 2


def squared_error(runs) -> np.ndarray:
    """Squared position error at k = 1, 2, ..., (trials, steps), in m^2."""
    return squared_distance(runs.error[:, 1:])


def final_error(runs) -> np.ndarray:
    """Position error at the last step, (trials,), in m."""
    return np.sqrt(squared_error(runs)[:, -1])


def lost(runs) -> np.ndarray:
    """Which runs end without the target, (trials,)."""
    return final_error(runs) > LOST_ABOVE


def rows(shards):
    rmse = metrics.roots_over_steps(shards.each(squared_error))
    yield "rmse", "position", metrics.statistic(rmse)
    yield "final_error", "position", metrics.mean(shards.each(final_error))
    if "triples" in shards.first.recorded:
        triples = shards.each(lambda runs: runs.recorded["triples"][:, 1:].mean(axis=1))
        yield "triples", "position", metrics.mean(triples)


def curves(shards):
    squared = shards.each(lambda runs: squared_distance(runs.error))
    yield "rmse", "position", metrics.root_mean(squared)
