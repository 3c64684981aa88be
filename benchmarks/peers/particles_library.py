"""The bootstrap filters of `ungm` and `rss_2d` in the library `particles`.

For benchmarks/particle_filters.py: a FeynmanKac of one's own, which the library runs four times
faster than distributions joined by IndepProd; systematic resampling at every step, the likelihood
(27) of PF-ROSS-EH, and of the moments only the mean.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import particles
from particles.collectors import Moments

from repro import plugins
from repro.logs import Log
from repro.network.energy_harvesting import transmission_probability

UNDERFLOWS = 1e-200  # sum of likelihoods, below which they are taken in logarithms
SQUARED_DISTANCE_FLOOR = 1e-12  # m^2


def bootstrap(log: Log, count: int, trials: int) -> Callable[[], np.ndarray]:
    """A function that filters the first trials and returns estimates of k = 1 ..., (trials, K, n).

    Its first call compiles the resampling.
    """
    model = plugins.study(log.study).model(log.parameters)
    of_study = {"ungm": Growth, "rss_2d": Tracking}[log.study]

    def run() -> np.ndarray:
        np.random.seed(log.seed)  # noqa: NPY002, of the library's resampling
        estimates = []
        for received in log.values["/received"][:trials, 1:]:
            algorithm = particles.SMC(
                fk=of_study(log.parameters, model, received),
                N=count,
                resampling="systematic",
                ESSrmin=1.0,
                collect=[Moments(mom_func=lambda w, x: w @ x)],
            )
            algorithm.run()
            estimates.append(algorithm.summaries.moments)
        return np.array(estimates).reshape(trials, model.steps, -1)

    return run


class OfStudy(particles.FeynmanKac):
    """What both have; the library's time t is the step k = t + 1."""

    def __init__(self, parameters: Any, model: Any, received: np.ndarray):
        super().__init__(T=len(received))
        self.parameters, self.model, self.received = parameters, model, received
        self.sends = transmission_probability(model.energy, model.steps, "lemma1")[1:]
        self.random = np.random.default_rng(received[0].view(np.uint64))


class Growth(OfStudy):
    """[energy_harvesting (29)]."""

    def M0(self, N):
        p = self.parameters
        return self.M(0, self.random.normal(p.prior_mean, np.sqrt(p.prior_variance), N))

    def M(self, t, xp):
        w = self.random.standard_gamma(2.0, len(xp)) * self.parameters.process_noise_scale
        return xp * (0.5 + 25.0 / (1.0 + xp * xp)) + (8.0 * np.cos(1.2 * t) + w)

    def logG(self, t, xp, x):
        p, sends, (gbar, limit) = self.parameters, self.sends[t], self.model.saturation
        rate, total = 1.0 / p.noise_mean, 1.0
        for offset, z in zip(p.sensor_offsets, self.received[t], strict=True):
            h = (x - offset) ** 2 * (1 / 20)
            error = np.maximum(z - h, 0.0)
            lost = (1 - sends) * rate * np.exp(-rate * z) if z >= 0 else 0.0
            at_limit = max(z - limit, 0.0)
            high = sends * gbar * rate * rate * at_limit * np.exp(-rate * at_limit) + lost
            beyond, factor = h > limit, sends * rate * rate  # h is not negative
            sent = np.where(beyond, (1 - gbar) * factor, factor) * error * np.exp(-rate * error)
            total = total * (sent + np.where(beyond, high, lost))
        if not total.any():
            return np.zeros(len(x))
        with np.errstate(divide="ignore"):
            return np.log(total)


class Tracking(OfStudy):
    """[energy_harvesting (30)-(32)]; particles are (N, 4)."""

    def __init__(self, parameters: Any, model: Any, received: np.ndarray):
        super().__init__(parameters, model, received)
        plant = model.plant
        move = np.array([[1.0, plant.time], [0.0, 1.0]])
        self.move, self.root = (np.kron(np.eye(2), axis).T for axis in (move, plant.root))
        self.slope = -5.0 * plant.exponent / np.log(10.0)
        self.at_one = plant.power - 2.0 * self.slope * np.log(plant.reference)
        self.variances = model.noise.measurement_variances + model.noise.channel_variance

    def M0(self, N):
        p, drawn = self.parameters, self.random.standard_normal((N, 4))
        x, v_x, y, v_y = p.true_initial_state
        speed = np.hypot(v_x, v_y) + np.sqrt(p.prior_speed_variance) * drawn[:, 1]
        azimuth = np.arctan2(v_y, v_x) + np.sqrt(p.prior_azimuth_variance) * drawn[:, 3]
        drawn[:, ::2] = (x, y) + np.sqrt(p.prior_position_variance) * drawn[:, ::2]
        drawn[:, 1], drawn[:, 3] = speed * np.cos(azimuth), speed * np.sin(azimuth)
        return self.M(0, drawn)

    def M(self, t, xp):
        return xp @ self.move + self.random.standard_normal(xp.shape) @ self.root

    def logG(self, t, xp, x):
        sends, (gbar, limit), z = self.sends[t], self.model.saturation, self.received[t]
        sensors, variances = self.model.plant.sensors, self.variances
        squared = (x[:, 0, None] - sensors[:, 0]) ** 2 + (x[:, 2, None] - sensors[:, 1]) ** 2
        h = self.at_one + self.slope * np.log(np.maximum(squared, SQUARED_DISTANCE_FLOOR))
        with np.errstate(divide="ignore"):
            lost = np.log(1 - sends) + log_normal(z, self.model.noise.channel_variance)
        low, high = (
            np.logaddexp(lost, np.log(sends * gbar) + log_normal(z - at, variances))
            for at in (-limit, limit)
        )
        below, above = h < -limit, h > limit
        clear = np.where(below | above, 1 - gbar, 1.0)
        quadratic = (z - h) ** 2 * (-0.5 / variances)

        def chosen(between, if_below, if_above):
            return np.where(below, if_below, np.where(above, if_above, between))

        peak = sends / np.sqrt(2 * np.pi * variances)
        rest = chosen(np.exp(lost), np.exp(low), np.exp(high))
        total = (peak * clear * np.exp(quadratic) + rest).prod(axis=1)
        if total.sum() < UNDERFLOWS:
            sent = np.log(peak * clear) + quadratic
            return np.logaddexp(sent, chosen(lost, low, high)).sum(axis=1)
        with np.errstate(divide="ignore"):
            return np.log(total)


def log_normal(error, variance):
    """Log density of N(0, variance)."""
    return -0.5 * (error * error / variance + np.log(2 * np.pi * variance))
