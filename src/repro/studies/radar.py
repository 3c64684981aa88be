"""Radar tracking with unknown measurement losses [unknown_losses Sec. VI-B]."""

from types import MappingProxyType
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from repro.logs import Log
from repro.models import Model, linear_system
from repro.models import radar as system
from repro.network import losses
from repro.parameters.values import (
    NotNegative,
    PointParameters,
    Positive,
    Probability,
    Triple,
    Values,
)
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.studies import Fields, Integers, Rows, StreamsOf, Study
from repro.studies.families.information import Information, of_model


class Parameters(PointParameters):
    """Values of one point; triples are position, velocity and acceleration along each axis."""

    sampling_time: Annotated[Positive, Field(description="tau, s")]
    manoeuvre_rate: Annotated[
        Positive, Field(description="alpha, reciprocal of the manoeuvre's time constant, 1/s")
    ]
    manoeuvre_deviation: Annotated[NotNegative, Field(description="sigma_m, m/s^2")]
    range_deviation: Annotated[Positive, Field(description="sigma_r, m")]
    bearing_deviation_deg: Annotated[Positive, Field(description="sigma_phi, degrees")]
    true_initial_mean: Annotated[Triple, Field(description="mean of the true x(0), m, m/s, m/s^2")]
    true_initial_state: Annotated[
        Literal["drawn", "mean"], Field(description="whether each run draws its own x(0)")
    ]
    initial_estimate: Annotated[Triple, Field(description="where the filters start, m, m/s, m/s^2")]
    first_measurement: Annotated[
        int, Field(ge=0, le=1, description="step of the first measurement that is used")
    ]
    known_input: Annotated[Triple, Field(description="u(k) of (21), m, m/s, m/s^2 a step")]
    bearing: Annotated[
        Literal["atan2, wrapped", "atan2", "arctan"],
        Field(description="function of the bearing; wrapped: its innovation lies in [-pi, pi)"),
    ]
    loss_process: Annotated[
        Literal["Bernoulli", "Markov"], Field(description="whether losses depend on the last one")
    ]
    loss_probability: Annotated[
        Probability, Field(description="Pr(gamma(k) = 0) of Bernoulli losses")
    ]
    loss_after_arrival: Annotated[
        Probability, Field(description="Pr(gamma(k) = 0 | gamma(k-1) = 1) of Markov losses")
    ]
    arrival_after_loss: Annotated[
        Probability, Field(description="Pr(gamma(k) = 1 | gamma(k-1) = 0) of Markov losses")
    ]


class Analysis(Values):
    """When a run has lost its target, and what the claims' words mean."""

    lost_above: Annotated[Positive, Field(description="m, error at the end of a lost run")]
    large_loss: Annotated[
        Probability, Field(description="smallest loss probability that counts as large")
    ]
    inferred_above: Annotated[
        Probability, Field(description="share of losses and arrivals that are inferred rightly")
    ]


def _measurement(x: np.ndarray, parameters: Parameters) -> np.ndarray:
    return system.measurement(x, "arctan" if parameters.bearing == "arctan" else "atan2")


def _noise_deviations(parameters: Parameters) -> np.ndarray:
    return np.array([parameters.range_deviation, np.deg2rad(parameters.bearing_deviation_deg)])


def _of_both_axes(along: Triple) -> np.ndarray:
    return np.tile(np.array(along, dtype=float), 2)


def _covariances(parameters: Parameters) -> tuple[np.ndarray, np.ndarray]:
    """Q and Sigma_0."""
    period, deviation = parameters.sampling_time, parameters.range_deviation
    process = system.process_covariance(
        period, parameters.manoeuvre_rate, parameters.manoeuvre_deviation
    )
    return process, system.initial_covariance(period, deviation)


def squared_distance(error: np.ndarray) -> np.ndarray:
    """Squared position error of (trials, steps, 6), in m^2."""
    return error[:, :, 0] ** 2 + error[:, :, 3] ** 2


def squared_error(runs: Runs) -> np.ndarray:
    """Squared position error at k = 1, 2, ..., (trials, steps), in m^2."""
    return squared_distance(runs.error[:, 1:])


def final_error(runs: Runs) -> np.ndarray:
    """Position error at the last step, (trials,), in m."""
    return np.sqrt(squared_error(runs)[:, -1])


def inferred_rightly(runs: Runs) -> np.ndarray:
    """Share of the steps at which the filter infers the loss or arrival rightly, (trials,)."""
    return losses.inferred_rightly(runs.recorded)


class Radar(Study):
    """Position error of a target that a radar with losses tracks [unknown_losses Figs. 3-5]."""

    Parameters = Parameters
    Analysis = Analysis
    keeps_inferred_arrivals = True
    # A call of NumPy costs as much as hundreds of systems, but more of six states leave the cache
    systems_per_block = 10000
    keeps_claimed_variance = False  # no table shows them
    trajectory = (("p1", "p2"),)
    error_unit = "m"
    kept_components = (system.STATE.index("p1"), system.STATE.index("p2"))
    judged_components = MappingProxyType({"position": kept_components})

    def topics(self, parameters: Parameters) -> Fields:
        return {
            "/truth": system.STATE,
            "/sensor": ("range", "bearing"),
            "/received": ("range", "bearing"),
            "/network": ("gamma",),
        }

    def period(self, parameters: Parameters) -> float:
        return parameters.sampling_time

    def first_step(self, parameters: Parameters) -> int:
        return parameters.first_measurement

    def simulate(self, parameters: Parameters, streams: StreamsOf) -> dict[str, np.ndarray]:
        steps, n = parameters.steps, len(system.STATE)
        process, prior = _covariances(parameters)
        x0 = linear_system.gaussian(prior, streams("prior").standard_normal(n))
        if parameters.true_initial_state == "mean":
            x0[:] = 0.0
        w = linear_system.gaussian(process, streams("process").standard_normal(steps, n))
        truth = linear_system.trajectory(
            system.transition_matrix(parameters.sampling_time),
            _of_both_axes(parameters.true_initial_mean) + x0,
            _of_both_axes(parameters.known_input) + w,
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

    def derived(self, parameters: Parameters) -> Fields:
        return {"/sensor": self.topics(parameters)["/sensor"]}

    def recomputed(self, log: Log) -> dict[str, np.ndarray]:
        received, gamma = log.values["/received"], log.values["/network"]
        noiseless = _measurement(log.values["/truth"], log.parameters)
        return {"/sensor": losses.sensed(received, gamma, noiseless)}

    def model(self, parameters: Parameters) -> Model:
        transition = system.transition_matrix(parameters.sampling_time)
        process, prior = _covariances(parameters)
        u = _of_both_axes(parameters.known_input)
        wrapped = parameters.bearing == "atan2, wrapped"
        return Model(
            transition=lambda x, k: linear_system.product(transition, x, u),
            transition_jacobian=lambda x, k: transition,
            measurement=lambda x, sensor: _measurement(x, parameters),
            measurement_jacobian=lambda x, sensor: system.measurement_jacobian(x),
            process_covariance=process,
            measurement_covariance=np.diag(_noise_deviations(parameters) ** 2),
            initial_mean=_of_both_axes(parameters.initial_estimate),
            initial_covariance=prior,
            network=losses.losses(parameters),
            innovation=system.wrapped_innovation if wrapped else np.subtract,
        )

    def channel_topics(self, parameters: Parameters) -> dict[str, Fields]:
        return {
            "received": {"/received": ("range", "bearing")},
            "arrival": {"/network": ("gamma",)},
        }

    def integers(self, parameters: Parameters) -> Integers:
        return {"/network": {"gamma": (0, 1)}}

    def channels(self, log: Log, trials: slice) -> losses.RecordedLosses:
        return losses.RecordedLosses(
            received=log.values["/received"][trials],
            arrival=log.field("/network", "gamma")[trials],
        )

    def information(self, log: Log) -> Information:
        gamma, first = log.field("/network", "gamma"), self.first_step(log.parameters)
        return of_model(self.model(log.parameters), log.values["/truth"], gamma, first)

    def squared_error(self, runs: Runs) -> np.ndarray:
        """Squared position error at k = 1, 2, ..., (trials, steps), in m^2."""
        return squared_error(runs)

    def lost(self, runs: Runs, analysis: Analysis) -> np.ndarray:
        """Which runs end without the target, (trials,)."""
        return final_error(runs) > analysis.lost_above

    def rows(self, shards: Shards, analysis: Analysis) -> Rows:
        rmse = metrics.roots_over_steps(shards.each(squared_error))
        yield "rmse", "position", metrics.statistic(rmse)
        yield "final_error", "position", metrics.mean(shards.each(final_error))
        if "arrived" in shards.first.recorded:
            yield "inferred", "gamma", metrics.mean(shards.each(inferred_rightly))
        if "triples" in shards.first.recorded:
            triples = shards.each(lambda runs: runs.recorded["triples"][:, 1:].mean(axis=1))
            yield "triples", "position", metrics.mean(triples)

    def curves(self, shards: Shards) -> Rows:
        squared = shards.each(lambda runs: squared_distance(runs.error))
        yield "rmse", "position", metrics.root_mean(squared)


STUDY = Radar()
