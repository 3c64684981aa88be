"""The studies: one file each, which joins a model, a network, a log and the paper's metrics.

A study's module gives STUDY, an object of a class below, and the class of its parameters.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from repro.logs import Log
from repro.network.channels import Channels
from repro.parameters.values import NoAnalysis, PointParameters, Values
from repro.statistics import metrics
from repro.statistics.metrics import Statistic
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.streams import Streams
from repro.studies.families.information import Information

Fields = dict[str, tuple[str, ...]]  # topic -> names of its fields
Integers = dict[str, dict[str, tuple[int, int]]]  # topic -> field -> least and greatest value
StreamsOf = Callable[[str], Streams]  # role -> its streams
Rows = Iterator[tuple[str, str, Statistic]]  # metric, component, statistic over the trials


class Study(ABC):
    """A scenario: what is simulated, what a filter may know and see of it, how it is judged."""

    Parameters: ClassVar[type[PointParameters]]
    Analysis: ClassVar[type[Values]] = NoAnalysis  # thresholds of its metrics and claims
    systems_per_block: ClassVar[int] = 250  # trials times particles that run side by side
    trajectory: ClassVar[tuple[tuple[str, str], ...]] = ()  # fields of /truth: y over x
    error_unit: ClassVar[str] = ""  # of the root of squared_error
    constant_topics: ClassVar[tuple[str, ...]] = ()  # of one message a trial
    topics_between_steps: ClassVar[tuple[str, ...]] = ()  # of one message a trial fewer than steps
    log_remark: ClassVar[str] = ""  # what a log recorded elsewhere must have, if unexpected
    kept_components: ClassVar[tuple[int, ...] | None] = None  # of the errors, in files; None: all
    keeps_claimed_variance: ClassVar[bool] = True  # the variances that the filters claim
    keeps_inferred_arrivals: ClassVar[bool] = False  # what the filters infer of the arrivals
    # Filters whose claim is the least error that any filter of a kind can have: which kind.
    best_filters: ClassVar[Mapping[str, str]] = MappingProxyType({})
    # Groups of components whose claimed covariance is judged, among those that are kept.
    judged_components: ClassVar[Mapping[str, Sequence[int]]] = MappingProxyType({})

    @abstractmethod
    def topics(self, parameters: Any) -> Fields:
        """Fields of each topic of the logs."""

    def derived(self, parameters: Any) -> Fields:
        """Fields of the topics that its logs leave out, as they follow bit by bit from the rest."""
        return {}

    def recomputed(self, log: Log) -> dict[str, np.ndarray]:
        """Values of the topics that have derived fields, from a log without them."""
        return {}

    def complete(self, log: Log) -> Log:
        """A log with the derived fields, from one without them."""
        fields, values = self.topics(log.parameters), log.values | self.recomputed(log)
        return log._replace(fields=fields, values={topic: values[topic] for topic in fields})

    def stored(self, parameters: Any) -> Fields:
        """Fields of each topic that its logs hold."""
        derived = self.derived(parameters)
        stored = {
            topic: tuple(name for name in names if name not in derived.get(topic, ()))
            for topic, names in self.topics(parameters).items()
        }
        return {topic: names for topic, names in stored.items() if names}

    @abstractmethod
    def simulate(self, parameters: Any, streams: StreamsOf) -> dict[str, np.ndarray]:
        """Values of each topic, (trials, steps, fields); streams(role) are a role's streams."""

    @abstractmethod
    def model(self, parameters: Any) -> Any:
        """What a filter knows of system and network."""

    @abstractmethod
    def channels(self, log: Log, trials: slice) -> Channels:
        """What a filter may see of a slice of the log's trials."""

    def channel_topics(self, parameters: Any) -> dict[str, Fields] | None:
        """Topics and fields that each channel is made of, so that a log may lack the others.

        None: any channel may be made of all of them but /truth.
        """
        return None

    def integers(self, parameters: Any) -> Integers:
        """The fields that are whole numbers, for the check of a log recorded elsewhere."""
        return {}

    def fault(self, log: Log) -> str | None:
        """What values of a log recorded elsewhere cannot go together; None if all can."""
        return None

    def rows(self, shards: Shards, analysis: Any) -> Rows:
        """The numbers of the study's table."""
        rmse = metrics.roots_over_steps(shards.each(self.squared_error))
        yield "rmse", "mean over k", metrics.statistic(rmse)

    def curves(self, shards: Shards) -> Rows:
        """The statistics over k."""
        yield "rmse", "over k", metrics.root_mean(shards.each(self.squared_error))

    def period(self, parameters: Any) -> float:
        """Seconds of log clock a step; 1 where the paper gives no unit of time."""
        return 1.0

    def first_step(self, parameters: Any) -> int:
        """0 if y(0) is used, without a prediction before it; else 1."""
        return 1

    def error(self, log: Log, estimate: np.ndarray) -> np.ndarray:
        """Error of every state component, (trials, steps, n)."""
        return estimate - log.values["/truth"]

    def squared_error(self, runs: Runs) -> np.ndarray:
        """Squared error of what the study is about, (trials, steps), by which filters are ranked.

        The whole state from the first estimated step on, unless a study overrides it.
        """
        return (runs.error**2).sum(axis=-1)[:, 1:]

    def counted(self, runs: Runs) -> np.ndarray:
        """The steps of each run at which its filter is judged, (trials, steps) of flags."""
        after_first = np.arange(runs.error.shape[1]) > 0
        return np.broadcast_to(after_first, runs.error.shape[:2])

    def information(self, log: Log) -> Information | None:
        """What the measurements of a log say, for a bound; None where no bound is known."""
        return None

    def lost(self, runs: Runs, analysis: Any) -> np.ndarray | None:
        """Which runs have lost what they track, (trials,); None where none can."""
        return None


class ClosedLoop(Study):
    """A study in which the filters act: each has its own truth under the same disturbances."""

    @abstractmethod
    def flight(self, log: Log, estimate: np.ndarray, runs: Runs) -> Log:
        """The log of what happened on a filter's estimates (trials, steps, n)."""
