"""Nearest-sensor scheduling in a closed loop [packet_delays Sec. 3.4, Algorithm 1].

The sensor that measures at step k is the one nearest to the target's predicted position, so what
a filter receives depends on its own predictions. The log holds the range to every sensor; this
module gives the filter the one that it would have received, without the step it is from.
"""

from typing import Any

import numpy as np

from repro.kernels import turn_and_schedule as kernels
from repro.network.channels import Channels


def nearest(positions: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Index of the nearest sensor; positions (trials, sensors, 2), target (trials, 2)."""
    tasked = np.empty(len(positions), dtype=np.int64)
    kernels.nearest(positions, np.array(target, dtype=float, order="C"), tasked)
    return tasked


class ScheduledRanges(Channels):
    """The channel of a batch of trials whose sensor is tasked by the filter's prediction.

    positions (trials, sensors, 2) in m; ranges (trials, steps, sensors) in m; origin and
    without_packet (trials, steps) as the network decided them; `offered` are further channels;
    `first` (2,) is the position on which step 0 is scheduled; packets are at most `bound` late.
    `true_positions` (trials, steps, 2), if given, are what the sensors are scheduled on instead.
    """

    on_prediction = True

    def __init__(
        self,
        positions: np.ndarray,
        ranges: np.ndarray,
        origin: np.ndarray,
        without_packet: np.ndarray,
        offered: dict[str, np.ndarray],
        first: np.ndarray,
        bound: int,
        true_positions: np.ndarray | None = None,
    ):
        self._positions = np.array(positions, dtype=float, order="C")
        self._ranges, self._offered = ranges, offered
        self._bound = bound
        self._origin, self._without_packet = origin.astype(int), without_packet
        self._true_positions = true_positions
        self._trials = np.arange(len(positions))
        self._tasked = np.zeros(origin.shape, dtype=int)
        self._task(0, np.tile(first, (len(positions), 1)))

    def _task(self, k: int, target: np.ndarray) -> None:
        if self._true_positions is not None:
            target = self._true_positions[:, k]
        self._tasked[:, k] = nearest(self._positions, target)

    def _position(self, k: int) -> np.ndarray:
        return self._positions[self._trials, self._tasked[:, k]]

    def at(self, k: int, fed_back: np.ndarray) -> dict[str, Any]:
        """The channels of step k for a filter whose prediction for it is `fed_back` (trials, n)."""
        self._task(k, fed_back[:, :2])
        origin = self._origin[:, k]
        sent = np.maximum(origin, 0)
        late = self._ranges[self._trials, sent, self._tasked[self._trials, sent]]
        return {
            "received": np.where(origin >= 0, late, self._without_packet[:, k]),
            "sensor": self._position(k),
            "earlier_sensors": [self._position(k - i) for i in range(1, min(self._bound, k) + 1)],
            **{name: channel[:, k] for name, channel in self._offered.items()},
        }

    def record(self) -> dict[str, np.ndarray]:
        """What the closed loop decided: index of the tasked sensor, (trials, steps)."""
        return {"tasked": self._tasked}
