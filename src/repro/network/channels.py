"""What a filter sees: the channels that it declares, and no others."""

from abc import ABC, abstractmethod
from typing import Any, ClassVar

import numpy as np

from repro.errors import ReproError

# Arguments of the model's functions, not impairments: every filter may know which sensor measures,
# and which input led to this step. None where a study has no such thing.
ALWAYS_SEEN = ("sensor", "earlier_sensors", "input")


class Channels(ABC):
    """What the network offers to a batch of trials, step by step."""

    # Whether `at` gets the prediction for step k instead of the last estimate.
    on_prediction: ClassVar[bool] = False

    @abstractmethod
    def at(self, k: int, fed_back: np.ndarray) -> dict[str, Any]:
        """The channels of step k, (trials, ...) each; `fed_back` is the filter's estimate."""

    def over(self, k: int, estimate: np.ndarray) -> np.ndarray | None:
        """Which trials are over at step k, (trials,): they keep their last values; None if none."""
        return None

    def record(self) -> dict[str, np.ndarray]:
        """Further arrays to keep with the runs, (trials, ...) each."""
        return {}

    def flown(self) -> dict[str, np.ndarray]:
        """Topics of the log of a closed loop."""
        return {}


class Recorded(Channels):
    """Channels of an open loop: arrays (trials, steps, ...) as the log holds them."""

    def __init__(self, **channels: np.ndarray):
        self._channels = channels

    def at(self, k: int, fed_back: np.ndarray) -> dict[str, Any]:
        return {name: channel[:, k] for name, channel in self._channels.items()}


class Seen:
    """The declared channels of one step as attributes; any other raises ReproError."""

    sensor: Any
    earlier_sensors: Any
    input: Any

    def __init__(self, name: str, declared: tuple[str, ...], offered: dict[str, Any]):
        self._name = name
        for channel in declared:
            if channel not in offered:
                raise ReproError(
                    f"filter {name}: SEES names the channel '{channel}', which this study does "
                    f"not have; it has {', '.join(c for c in offered if c not in ALWAYS_SEEN)}"
                )
        for channel in ALWAYS_SEEN:
            setattr(self, channel, offered.get(channel))
        for channel in declared:
            setattr(self, channel, offered[channel])

    def __getattr__(self, channel: str) -> Any:
        raise ReproError(
            f"filter {self._name}: reads the channel '{channel}', which its SEES does not declare"
        )
