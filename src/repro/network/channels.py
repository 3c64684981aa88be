"""What a filter sees: the channels that it declares, and nothing else."""

import numpy as np

from repro.errors import ReproError

# Not impairments but part of the model's functions: every filter may know which sensor measures and
# which input drove the system to this step. None where a study has no such thing.
ALWAYS_SEEN = ("sensor", "earlier_sensors", "input")


class Recorded:
    """Channels of an open loop: arrays (trials, steps, ...) as the log holds them.

    A closed loop may have besides
        ON_PREDICTION       True: `at` gets the prediction for step k, not the last estimate
        over(k, estimate)   (trials,): which trials are over; they keep their last values
        flown()             topics of the log of what was flown
    """

    def __init__(self, **channels: np.ndarray):
        self._channels = channels

    def at(self, k: int, fed_back: np.ndarray) -> dict:
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
