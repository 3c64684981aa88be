"""Three coupled targets, censored measurements, random access [censored_network Sec. IV].

The studies `deadband` and `saturation` are instances of this one; only their parameters differ.
Equation numbers are those of that paper.
"""

from collections.abc import Callable
from types import MappingProxyType

import numpy as np

from repro.logs import Log
from repro.models.coupled_targets import CoupledTargets, SignalStrength, drift, pull
from repro.models.mixture_noise import MixtureNoise
from repro.network.censoring import EXACT, INSIDE, Censoring, censored
from repro.network.channels import Recorded
from repro.network.random_access import transmitted, transmitting_group
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.studies import Fields, Integers, Rows, StreamsOf, Study
from repro.studies.families.censored_network_parameters import Analysis, Parameters

TARGETS = ("1", "2", "3")
COMPONENTS = (*(f"target_{i}" for i in TARGETS), "average")
STATE = ("px", "py", "phi")


def sensors(parameters: Parameters) -> np.ndarray:
    """Positions (M, b, 2) in m."""
    return np.array(parameters.sensor_groups, dtype=float)


def squared_distance(runs: Runs) -> np.ndarray:
    """Squared position error of each target, (trials, steps + 1, targets), in m^2."""
    error = runs.error.reshape(*runs.error.shape[:2], len(TARGETS), len(STATE))
    return (error[..., :2] ** 2).sum(axis=-1)


def effective_sample_size(runs: Runs) -> np.ndarray:
    """Of each step, averaged over the targets' filters, (trials, steps + 1)."""
    return runs.recorded["effective_sample_size"]


def _with_average(metric: str, of_targets: list[metrics.Jackknife]) -> Rows:
    """The targets and their mean, which is how the paper averages."""
    numbers = [*of_targets, metrics.average(of_targets)]
    for component, number in zip(COMPONENTS, numbers, strict=True):
        yield metric, component, metrics.statistic(number)


class CensoredNetwork(Study):
    """Three coupled targets; whether the censoring is a dead band or saturation is a parameter."""

    Parameters = Parameters
    Analysis = Analysis
    systems_per_block = 20
    judged_components = MappingProxyType(
        {f"target_{i}": (3 * n, 3 * n + 1) for n, i in enumerate(TARGETS)}
    )
    error_unit = "m"
    trajectory = tuple((f"px_{i}", f"py_{i}") for i in TARGETS)

    def topics(self, parameters: Parameters) -> Fields:
        groups, size, _ = sensors(parameters).shape
        names = [f"{m}_{j}" for m in range(1, groups + 1) for j in range(1, size + 1)]
        return {
            "/truth": tuple(f"{name}_{i}" for i in TARGETS for name in STATE),
            "/sensor": tuple(f"strength_{i}_{name}" for i in TARGETS for name in names),
            "/received": tuple(
                f"{quantity}_{i}_{j}"
                for quantity in ("value", "code")
                for i in TARGETS
                for j in range(1, size + 1)
            ),
            "/network": tuple(f"{event}_{i}" for event in ("group", "coupled") for i in TARGETS),
        }

    def model(self, parameters: Parameters) -> CoupledTargets:
        return CoupledTargets(
            initial_mean=np.ravel(parameters.initial_states),
            initial_deviation=np.array(parameters.initial_deviation),
            speed=np.array(parameters.speed),
            turn_rate=parameters.turn_rate,
            process_deviation=np.array(parameters.process_deviation),
            coupling=np.where(
                np.eye(len(TARGETS), dtype=bool),
                parameters.self_coupling_strength,
                parameters.coupling_strength,
            ),
            coupling_rate=parameters.coupling_rate,
            sensors=sensors(parameters),
            strength=SignalStrength(
                parameters.strength_at_reference,
                parameters.path_loss_exponent,
                parameters.reference_distance,
            ),
            noise=MixtureNoise(
                parameters.glint_probability,
                parameters.nominal_deviation,
                parameters.glint_deviation,
            ),
            censoring=Censoring(
                parameters.censoring,
                parameters.lower_threshold,
                parameters.upper_threshold,
                parameters.dead_band_constant,
            ),
        )

    def simulate(self, parameters: Parameters, streams: StreamsOf) -> dict[str, np.ndarray]:
        known, steps, nodes = self.model(parameters), parameters.steps, len(TARGETS)
        groups, size, _ = known.sensors.shape
        process, network, sensor = streams("process"), streams("network"), streams("sensor")
        trials = len(process)
        noise = known.process_deviation * process.standard_normal(steps, nodes, len(STATE))
        network_uniform = network.uniform(steps + 1, 2, nodes)  # by step: horizons share them
        coupled = network_uniform[:, :, 0] < known.coupling_rate
        group = transmitting_group(
            network_uniform[:, :, 1], np.array(parameters.group_probabilities)
        )

        truth = np.empty((trials, steps + 1, nodes, len(STATE)))
        truth[:, 0] = known.initial_mean.reshape(nodes, len(STATE))
        for k in range(steps):  # (23), all targets from their states of step k
            x = truth[:, k]
            pushed = coupled[:, k, :, None] * pull(x, known.coupling)
            truth[:, k + 1] = drift(x, known.speed, known.turn_rate) + pushed + noise[:, k]

        # (24)-(25); (trials, steps + 1, nodes, M, b)
        offset = truth[..., None, None, :2] - known.sensors
        ideal = known.strength.of_squared_distance((offset**2).sum(axis=-1))
        shape = (steps + 1, nodes, groups, size)
        glint = sensor.uniform(*shape)
        ideal = ideal + known.noise.sample(glint, sensor.standard_normal(*shape))

        readings, codes = censored(ideal, known.censoring)
        values, value_codes = transmitted(readings, group), transmitted(codes, group)
        flat = (trials, steps + 1, -1)
        return {
            "/truth": truth.reshape(flat),
            "/sensor": ideal.reshape(flat),
            "/received": np.concatenate(
                [values.reshape(flat), value_codes.reshape(flat).astype(float)], axis=-1
            ),
            "/network": np.concatenate([group + 1.0, coupled.astype(float)], axis=-1),
        }

    def channel_topics(self, parameters: Parameters) -> dict[str, Fields]:
        values, codes = np.split(np.array(self.topics(parameters)["/received"]), 2)
        groups = [f"group_{i}" for i in TARGETS] if parameters.group_known else []
        return {
            "received": {"/received": tuple(values.tolist())},
            "code": {"/received": tuple(codes.tolist())},
            "group_probability": {"/network": tuple(groups)} if groups else {},
        }

    def integers(self, parameters: Parameters) -> Integers:
        codes = self.channel_topics(parameters)["code"]["/received"]
        groups = len(parameters.sensor_groups)
        return {
            "/received": dict.fromkeys(codes, (EXACT, INSIDE)),
            "/network": {f"group_{i}": (1, groups) for i in TARGETS},
        }

    def channels(self, log: Log, trials: slice) -> Recorded:
        """Values and codes (trials, steps, nodes, b); the group only if `group_known`."""
        parameters = log.parameters
        received = log.values["/received"][trials]
        values, codes = np.split(
            received.reshape(*received.shape[:2], 2 * len(TARGETS), -1), 2, axis=2
        )
        probabilities = np.array(parameters.group_probabilities)
        shape = (*values.shape[:3], len(probabilities))
        known = np.broadcast_to(probabilities, shape)
        if parameters.group_known:
            group = log.values["/network"][trials][:, :, : len(TARGETS)]
            known = (group[..., None] == np.arange(1, shape[-1] + 1)).astype(float)
        return Recorded(received=values, code=codes.astype(int), group_probability=known)

    def squared_error(self, runs: Runs) -> np.ndarray:
        """Squared position error, mean of the targets, from k = 1, (trials, steps), in m^2."""
        return squared_distance(runs)[:, 1:].mean(axis=-1)

    def lost(self, runs: Runs, analysis: Analysis) -> np.ndarray:
        """Whether a run loses a target at some step, (trials,)."""
        return squared_distance(runs)[:, 1:].max(axis=(1, 2)) > analysis.lost_above**2

    def rows(self, shards: Shards, analysis: Analysis) -> Rows:
        def squared(target: int, steps: slice) -> Callable[[Runs], np.ndarray]:
            return lambda runs: squared_distance(runs)[:, steps, target]

        for metric, steps in (
            ("rmse", slice(1, None)),  # (26), averaged over k = 1 ... K
            ("rmse_from_0", slice(None)),
            (f"rmse_first_{analysis.short_horizon}", slice(1, analysis.short_horizon + 1)),
        ):
            of_targets = [shards.each(squared(i, steps)) for i in range(len(TARGETS))]
            yield from _with_average(metric, [metrics.roots_over_steps(of) for of in of_targets])
        mean_squared = [
            shards.each(lambda runs, i=i: squared_distance(runs)[:, 1:, i].mean(axis=1))
            for i in range(len(TARGETS))
        ]
        yield from _with_average("rmse_root_of_mean", [metrics.root(of) for of in mean_squared])
        if "effective_sample_size" in shards.first.recorded:
            effective = shards.each(lambda runs: effective_sample_size(runs)[:, 1:].mean(axis=1))
            yield "effective_sample_size", "average", metrics.mean(effective)

    def curves(self, shards: Shards) -> Rows:
        for i, component in enumerate(COMPONENTS[:-1]):
            squared = shards.each(lambda runs, i=i: squared_distance(runs)[:, :, i])
            yield "rmse", component, metrics.root_mean(squared)
        if "effective_sample_size" in shards.first.recorded:
            effective = shards.each(effective_sample_size)
            yield "effective_sample_size", "average", metrics.mean(effective)
