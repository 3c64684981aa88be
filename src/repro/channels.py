"""What a filter sees: the channels that it declares, and nothing else."""

import numpy as np

from repro.errors import ReproError

# Not impairments but part of the measurement function: every filter may know which sensor measures.
# None where a study schedules no sensors.
ALWAYS_SEEN = ("sensor", "earlier_sensors")


class Recorded:
    """Channels of an open loop: arrays (trials, steps, ...) as the log holds them."""

    def __init__(self, **channels: np.ndarray):
        self._channels = channels

    def at(self, k: int, predicted: np.ndarray | None) -> dict:
        """What the network offers at step k; here it does not depend on the filter."""
        return {name: channel[:, k] for name, channel in self._channels.items()}

    def record(self) -> dict:
        """What the loop decided besides: nothing."""
        return {}


class Seen:
    """The declared channels of one step as attributes; any other name is refused in one line."""

    def __init__(self, name: str, declared: tuple[str, ...], offered: dict):
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

    def __getattr__(self, channel: str):
        raise ReproError(
            f"filter {self._name}: reads the channel '{channel}', which its SEES does not declare"
        )
