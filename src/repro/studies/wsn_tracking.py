"""Target tracking in a wireless sensor network with packet delays [packet_delays Sec. 4.2]."""

from types import MappingProxyType

import numpy as np

from repro.kernels import turn_and_schedule
from repro.logs import Log
from repro.models import DelayNetwork, Model, coordinated_turn, linear_system
from repro.network import packet_delays
from repro.network.tasking import ScheduledRanges
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.studies import Fields, Integers, Rows, StreamsOf, Study
from repro.studies.families.wsn_tracking_parameters import Analysis, Parameters

STATE = ("px", "py", "vx", "vy", "omega")
POSITION = (STATE.index("px"), STATE.index("py"))


def _lossy(parameters: Parameters) -> bool:
    return parameters.channel == "lossy"


def _time(parameters: Parameters, k: int) -> float:
    """T of the step k -> k+1 in s; `k` takes the printed angle k omega(k) literally."""
    return float(k) if parameters.sampling_time == "k" else parameters.sampling_time


def _trajectory(parameters: Parameters, streams: StreamsOf) -> np.ndarray:
    steps = parameters.steps
    prior, process = streams("prior"), streams("process")
    truth = np.empty((len(prior), steps + 1, len(STATE)))
    truth[:, 0] = parameters.initial_estimate
    if parameters.true_initial_state == "drawn":
        root = linear_system.root(np.array(parameters.initial_covariance))
        truth[:, 0] += (root * prior.standard_normal(1, len(STATE))).sum(axis=-1)
    turn = np.sqrt(parameters.true_turn_rate_variance) * process.standard_normal(steps)
    for k in range(steps):
        truth[:, k + 1] = coordinated_turn.transition(truth[:, k], _time(parameters, k))
        truth[:, k + 1, 4] += turn[:, k]
    return truth


def _received(noise: np.ndarray, delay: np.ndarray) -> np.ndarray:
    """Step that a packet is from, and y without one, (trials, steps + 1, 2)."""
    received = [packet_delays.origins(delay), packet_delays.value_without_packet(noise, delay)]
    return np.stack(received, axis=-1).astype(float)


def positions(log: Log) -> np.ndarray:
    """Sensor positions of each trial, (trials, sensors, 2), in m."""
    field = log.values["/field"]
    return field.reshape(len(field), -1, 2)


def position_error(runs: Runs) -> np.ndarray:
    """Er(k) [packet_delays Sec. 4.2.2] of xh(k|k), (trials, steps + 1), in m."""
    return np.sqrt(runs.error[:, :, 0] ** 2 + runs.error[:, :, 1] ** 2)


class WsnTracking(Study):
    """A target on a circle; in each step the sensor nearest to the predicted position measures.

    The range reaches the filter on time, up to N steps late, or never.
    """

    Parameters = Parameters
    Analysis = Analysis
    systems_per_block = 1000
    trajectory = (("px", "py"),)
    error_unit = "m"
    kept_components = POSITION
    judged_components = MappingProxyType({"position": POSITION})
    keeps_claimed_variance = False  # no table shows them
    constant_topics = ("/field",)
    log_remark = (
        "a filter's own prediction chooses the sensor, so the log must have the range to every "
        "sensor at every step, and for each step the one whose packet arrives"
    )

    def topics(self, parameters: Parameters) -> dict[str, tuple[str, ...]]:
        sensors = range(1, parameters.sensors + 1)
        flags = packet_delays.flags_per_step(parameters.packet_bound, _lossy(parameters))
        return {
            "/truth": STATE,
            "/field": tuple(f"{axis}_{s}" for s in sensors for axis in ("x", "y")),
            "/sensor": ("noise", *(f"range_{s}" for s in sensors)),
            "/received": ("origin", "without_packet"),
            "/network": (*(f"gamma_{i}" for i in range(flags)), "delay"),
        }

    def simulate(self, parameters: Parameters, streams: StreamsOf) -> dict[str, np.ndarray]:
        steps, bound = parameters.steps, parameters.packet_bound
        truth = _trajectory(parameters, streams)
        sensor = streams("sensor")
        # One sensor measures in a step, so one value of the noise is enough, whichever it is.
        v = np.sqrt(parameters.measurement_variance) * sensor.standard_normal(steps + 1)
        positions = parameters.field_side * sensor.uniform(parameters.sensors, 2)
        if parameters.layout == "fixed":
            positions[:] = parameters.field_side * np.array(parameters.fixed_layout)
        ranges = np.empty((*v.shape, parameters.sensors + 1))
        turn_and_schedule.ranges(truth, positions, v, ranges)
        flags = packet_delays.arrival_flags(
            streams("network").uniform(
                packet_delays.flags_per_step(bound, _lossy(parameters)), steps + 1
            ),  # one flag after the other: N = 0, 1 and 2 share theirs
            parameters.arrival_probability,
        )
        delay = packet_delays.delays(flags, bound)
        return {
            "/truth": truth,
            "/field": positions.reshape(len(positions), 1, -1),
            "/sensor": ranges,
            "/received": _received(v, delay),
            "/network": np.concatenate(
                [np.moveaxis(flags, 1, -1), delay[:, :, None].astype(float)], axis=-1
            ),
        }

    def derived(self, parameters: Parameters) -> Fields:
        topics = self.topics(parameters)  # the ranges alone are three quarters of a log
        return {"/sensor": topics["/sensor"][1:], "/received": topics["/received"]}

    def recomputed(self, log: Log) -> dict[str, np.ndarray]:
        noise = np.ascontiguousarray(log.field("/sensor", "noise"))
        sensor = np.empty((*noise.shape, log.parameters.sensors + 1))
        turn_and_schedule.ranges(log.values["/truth"], positions(log), noise, sensor)
        delay = log.field("/network", "delay").astype(int)
        return {"/sensor": sensor, "/received": _received(noise, delay)}

    def model(self, parameters: Parameters) -> Model:
        process_covariance = np.zeros((len(STATE), len(STATE)))
        process_covariance[4, 4] = parameters.turn_rate_variance
        return Model(
            transition=lambda x, k: coordinated_turn.transition(x, _time(parameters, k)),
            transition_jacobian=lambda x, k: coordinated_turn.transition_jacobian(
                x, _time(parameters, k)
            ),
            measurement=lambda x, sensor: coordinated_turn.distance(x, sensor)[..., None],
            measurement_jacobian=coordinated_turn.distance_jacobian,
            process_covariance=process_covariance,
            measurement_covariance=np.array([[parameters.measurement_variance]]),
            initial_mean=np.array(parameters.initial_estimate, dtype=float),
            initial_covariance=np.array(parameters.initial_covariance),
            network=DelayNetwork(parameters.arrival_probability, parameters.packet_bound),
        )

    def channel_topics(self, parameters: Parameters) -> dict[str, Fields]:
        # The sensor of each step, which every filter may know, comes out of the same loop.
        topics = self.topics(parameters)
        loop = {
            "/field": topics["/field"],
            "/sensor": topics["/sensor"][1:],
            "/received": topics["/received"],
        }
        if parameters.scheduled_on == "true position":
            loop["/truth"] = STATE[:2]
        told = loop | {"/network": ("delay",)}
        return {
            "received": loop,
            "sensor": loop,
            "earlier_sensors": loop,
            "arrival": told,
            "delay": told,
        }

    def integers(self, parameters: Parameters) -> Integers:
        bound = parameters.packet_bound
        return {
            "/received": {"origin": (-max(bound, 1), parameters.steps)},
            "/network": {"delay": (packet_delays.least_delay(bound, _lossy(parameters)), bound)},
        }

    def fault(self, log: Log) -> str | None:
        """A packet that is from a later step, or older than the bound."""
        origin, bound = log.field("/received", "origin"), log.parameters.packet_bound
        late = np.arange(origin.shape[1]) - origin
        wrong = (origin >= 0) & ((late < 0) | (late > bound))
        if not wrong.any():
            return None
        trial, step = np.argwhere(wrong)[0]
        return (
            f"topic /received: the field 'origin' of trial {log.trials[trial]}, step {step} is "
            f"{origin[trial, step]:g}; a packet is at most {bound} steps late"
        )

    def channels(self, log: Log, trials: slice) -> ScheduledRanges:
        parameters = log.parameters
        delay = log.field("/network", "delay")[trials]
        on_truth = parameters.scheduled_on == "true position"
        return ScheduledRanges(
            positions=positions(log)[trials],
            ranges=log.values["/sensor"][trials, :, 1:],
            origin=log.field("/received", "origin")[trials],
            without_packet=log.field("/received", "without_packet")[trials],
            offered={"arrival": (delay == 0).astype(float), "delay": delay},
            first=np.array(parameters.initial_estimate[:2], dtype=float),
            bound=parameters.packet_bound,
            true_positions=log.values["/truth"][trials, :, :2] if on_truth else None,
        )

    def squared_error(self, runs: Runs) -> np.ndarray:
        """Squared position error at k = 1, 2, ..., (trials, steps), in m^2."""
        return position_error(runs)[:, 1:] ** 2

    def lost(self, runs: Runs, analysis: Analysis) -> np.ndarray:
        """Which runs lose the target, (trials,)."""
        return np.any(position_error(runs)[:, 1:] > analysis.lost_above, axis=1)

    def rows(self, shards: Shards, analysis: Analysis) -> Rows:
        mean_error = shards.each(lambda runs: position_error(runs)[:, 1:].mean(axis=1))
        yield "saee", "position", metrics.mean(mean_error)
        largest_error = shards.each(lambda runs: position_error(runs)[:, 1:].max(axis=1))
        yield "max_error", "position", metrics.mean(largest_error)

    def curves(self, shards: Shards) -> Rows:
        yield "error", "position", metrics.mean(shards.each(position_error))


STUDY = WsnTracking()
