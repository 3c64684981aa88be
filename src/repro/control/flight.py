"""A quadrotor flown on a filter's estimate: the loop of [unknown_losses Fig. 7].

Order of a step: y(k) -> update -> controller -> plant step with the current rotor speeds -> motor
step. So y(k + 1) depends on the estimate at k, and each filter has its own truth under the same
disturbances. A flight that tumbles, or leaves, ends: its state stays as it was last.
"""

from typing import Any, NamedTuple

import numpy as np

from repro.control import cascaded_pid
from repro.kernels import quadrotor_flight as kernels
from repro.models import quadrotor
from repro.network.channels import Channels


class System(NamedTuple):
    """Quadrotor, controller, and the limits beyond which a flight ends."""

    frame: quadrotor.Airframe
    motor: quadrotor.Motor
    controller: cascaded_pid.Settings
    period: float  # s
    tilt_limit: float  # rad of roll or pitch beyond which a flight has tumbled
    range_limit: float  # m from the origin beyond which a flight has left

    def constants(self) -> tuple[Any, ...]:
        """As the kernels have them."""
        return (
            self.frame.constants(),
            self.motor.constants(),
            self.motor.decay(self.period),
            self.controller.gains(),
            self.controller.limits(),
            self.period,
            (self.tilt_limit, self.range_limit),
        )


class Flight(Channels):
    """The channels of a batch of flights.

    process (flights, steps, 12), noise (flights, steps + 1, 12) and gamma (flights, steps + 1) are
    the disturbances; reference (steps + 1, 4) is X, Y, Z in m and psi in rad; start (12,) is the
    true initial state and start_speed that of all rotors in RPM.
    """

    def __init__(
        self,
        system: System,
        process: np.ndarray,
        noise: np.ndarray,
        gamma: np.ndarray,
        reference: np.ndarray,
        start: np.ndarray,
        start_speed: float,
    ):
        self._constants, self._period = system.constants(), system.period
        self._reference = reference
        self._process, self._noise, self._gamma = process, noise, gamma
        flights, samples = gamma.shape
        self._truth = np.empty((flights, samples, 12))
        self._truth[:, 0] = start
        self._received = np.empty(self._truth.shape)
        self._throttle = np.empty((flights, samples - 1, 4))
        self._speeds = np.full((flights, 4), start_speed)
        self._memory: cascaded_pid.Memory | None = None
        self._end = np.full(flights, samples)  # first step that is not flown

    def at(self, k: int, fed_back: np.ndarray) -> dict[str, np.ndarray]:
        """What sensors and network offer at step k, flown on the estimate of step k - 1."""
        speeds = self._speeds
        if k > 0:
            self._fly(k - 1, fed_back)
        truth, noise, gamma = self._truth[:, k], self._noise[:, k], self._gamma[:, k]
        self._received[:, k] = gamma[:, None] * truth + noise  # (2) with h(x) = x
        return {
            "received": self._received[:, k],
            "without_loss": truth + noise,
            "arrival": gamma,
            "truth": truth,
            "input": speeds,
        }

    def _fly(self, k: int, estimate: np.ndarray) -> None:
        """Controller at step k, then plant and motors from k to k + 1."""
        if self._memory is None:
            self._memory = cascaded_pid.start(estimate)
        truth, throttle = np.empty((2, len(estimate), 12)), np.empty((len(estimate), 4))
        truth[0] = self._truth[:, k]
        after = np.empty(self._speeds.shape)
        kernels.fly(
            k,
            self._constants,
            tuple(self._memory),
            np.array(estimate, dtype=float, order="C"),
            self._reference[k],
            np.array(self._process[:, k], order="C"),
            truth[0],
            self._speeds,
            self._end,
            truth[1],
            throttle,
            after,
            (np.empty(6), *quadrotor.stages_scratch()),
        )
        self._truth[:, k + 1], self._throttle[:, k], self._speeds = truth[1], throttle, after

    def over(self, k: int, estimate: np.ndarray) -> np.ndarray:
        """Which flights are over at step k, (flights,); one without a finite estimate is."""
        lost = (self._end > k) & ~np.isfinite(estimate).all(axis=1)
        self._end[lost] = k
        return self._end <= k

    def record(self) -> dict[str, np.ndarray]:
        """Positions, distances to the reference, losses, and when each flight ended (step, s)."""
        position = self._truth[:, :, quadrotor.POSITION]
        return {
            "position": position,
            "distance": np.sqrt(((position - self._reference[:, :3]) ** 2).sum(axis=-1)),
            "gamma": self._gamma,
            "end": self._end,
            "end_time": np.minimum(self._end, len(self._reference) - 1) * self._period,
        }

    def flown(self) -> dict[str, np.ndarray]:
        """Topics of the flight log that the loop itself decided."""
        return {"/truth": self._truth, "/received": self._received, "/throttle": self._throttle}
