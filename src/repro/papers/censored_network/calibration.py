"""The geometry that censored_network does not state, and how far it is from Tables I and II.

What was fitted: two groups of sensors, the speed v, the turn rate Omega and the horizon K. Fitted
to: 24 time-averaged RMSEs, a row of three targets for each filter and study.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, NamedTuple, Self

import numpy as np
from pydantic import Field

from repro import plugins
from repro.kernels import arrays
from repro.papers.censored_network.time_averages import POINT
from repro.parameters.values import Pair, PointParameters, Positive, Values
from repro.runner import run
from repro.simulate import simulated
from repro.statistics import metrics
from repro.studies.families.censored_network import TARGETS, squared_distance
from repro.verdicts.published import read_published

TARGET = "target_"  # begins the name of a target's component
Row = tuple[str, str]  # study and filter: a row of Tables I and II
Count = Annotated[int, Field(ge=1)]
Trials = Annotated[int, Field(ge=2)]  # of which each can be left out


def with_average(of_targets: np.ndarray) -> np.ndarray:
    """The targets and their mean, (..., targets) to (..., targets + 1)."""
    return np.concatenate([of_targets, of_targets.mean(axis=-1, keepdims=True)], axis=-1)


def mean_of_roots(squared: np.ndarray) -> np.ndarray:
    """Mean over the steps of the roots, (..., steps, targets) to (..., targets + 1)."""
    return with_average(np.sqrt(squared).mean(axis=-2))


class Search(Values):
    """Box and effort of the search: section `calibration` of the parameter file."""

    sensor_range: Annotated[Pair, Field(description="m, both coordinates of a sensor")]
    speed_range: Annotated[Pair, Field(description="m per step, v, the same for all targets")]
    turn_rate_range: Annotated[Pair, Field(description="rad per step, Omega")]
    steps_range: Annotated[tuple[Count, Count], Field(description="steps, K")]
    screened: Annotated[Count, Field(description="geometries drawn at random to start from")]
    starts: Annotated[Count, Field(description="searches from the screened geometries")]
    left_out_starts: Annotated[Count, Field(description="of these for each row left out")]
    evaluations: Annotated[Count, Field(description="evaluations of the misfit in a search")]
    first_step: Annotated[Positive, Field(description="of the search, as a share of the box")]
    trials: Annotated[Trials, Field(description="trials of an evaluation, the same in all")]
    particles: Annotated[Trials, Field(description="particles of a node in an evaluation")]
    confirming_trials: Annotated[Trials, Field(description="trials that no search has seen")]
    first_trial: Annotated[int, Field(ge=0, description="first trial number; tables have others")]
    profile_values: Annotated[Count, Field(description="values of v, Omega and K in a profile")]

    def with_budget(self, budget: float) -> Self:
        """The same search with a share of its effort; of judging, the share's root."""
        return self.model_copy(
            update={
                "screened": max(self.starts, round(budget * self.screened)),
                "evaluations": max(1, round(budget * self.evaluations)),
                "confirming_trials": max(2, round(budget**0.5 * self.confirming_trials)),
            }
        )


class Geometry(NamedTuple):
    """What the paper does not state."""

    sensors: np.ndarray  # (groups, sensors of a group, 2), m
    speed: float  # m per step
    turn_rate: float  # rad per step
    steps: int

    @classmethod
    def of(cls, parameters: Any) -> Self:
        """That of a point, whose targets have one speed."""
        sensors = np.array(parameters.sensor_groups)
        return cls(sensors, parameters.speed[0], parameters.turn_rate, parameters.steps)

    def columns(self) -> dict[str, float]:
        """A column of a table for each number."""
        places = {
            f"group_{m + 1}_{axis}_{j + 1}": float(self.sensors[m, j, i])
            for m, j in np.ndindex(self.sensors.shape[:2])
            for i, axis in enumerate("xy")
        }
        return places | {"speed": self.speed, "turn_rate": self.turn_rate, "steps": self.steps}

    def set_in(self, parameters: PointParameters) -> PointParameters:
        """The parameters of a point with this geometry."""
        return parameters.model_copy(
            update={
                "sensor_groups": tuple(tuple(map(tuple, g)) for g in self.sensors.tolist()),
                "speed": (self.speed,) * len(TARGETS),
                "turn_rate": self.turn_rate,
                "steps": self.steps,
            }
        )


class Box:
    """Geometries as points of a cube: shares of the ranges of their numbers."""

    def __init__(self, search: Search, sensors: tuple[int, int]):
        """`sensors` are the number of groups, and of sensors in each."""
        self._sensors = (*sensors, 2)
        places = [search.sensor_range] * int(np.prod(self._sensors))
        ranges = [*places, search.speed_range, search.turn_rate_range, search.steps_range]
        self._lowest, self._highest = np.array(ranges, dtype=float).T
        self.dimension = len(ranges)

    def geometry(self, shares: np.ndarray) -> Geometry:
        """The geometry at a point of the cube, K rounded to an integer."""
        *places, speed, turn_rate, steps = (
            self._lowest + shares * (self._highest - self._lowest)
        ).tolist()
        return Geometry(np.reshape(places, self._sensors), speed, turn_rate, round(steps))

    def shares(self, geometry: Geometry) -> np.ndarray:
        """The point of the cube that gives a geometry."""
        numbers = np.array([*geometry.sensors.ravel(), *geometry[1:]])
        return (numbers - self._lowest) / (self._highest - self._lowest)


class Printed(NamedTuple):
    """Tables I and II without the averages, or some of their rows."""

    rows: list[Row]
    values: np.ndarray  # RMSE of each row and target, (rows, targets), in m
    trials: int

    @classmethod
    def read(cls, published: str | Path) -> Self:
        """The rows that a file of published values has."""
        found = read_published(published)
        of_targets = (found["kind"] == "value") & found["component"].str.startswith(TARGET)
        found = found.loc[of_targets]
        rows = list(dict.fromkeys(zip(found["study"], found["filter"], strict=True)))
        values = found["value"].to_numpy(float).reshape(len(rows), len(TARGETS))
        return cls(rows, values, int(found["trials"].to_numpy()[0]))

    def without(self, left_out: Row | None) -> Self:
        """All rows but one."""
        kept = [row != left_out for row in self.rows]
        rows = [row for row in self.rows if row != left_out]
        return self._replace(rows=rows, values=self.values[kept])


class Network:
    """Both studies at any geometry, on the same random numbers at each."""

    def __init__(
        self,
        points: Mapping[str, Mapping[str, Any]],
        search: Mapping[str, Any],
        seed: int,
        budget: float = 1.0,
    ):
        """The network of the parameter file, as JSON has it.

        `points` have, by study, parameters and settings of the filters; `search` is the section
        `calibration`, of whose effort `budget` is a share.
        """
        self._parameters = {
            study: plugins.study(study).Parameters.checked(point["parameters"], study)
            for study, point in points.items()
        }
        self._settings = {study: point["filters"] for study, point in points.items()}
        checked = Search.checked(search, "params/censored_network.yaml: calibration")
        self.seed, self.search = seed, checked.with_budget(budget)
        self.committed = Geometry.of(next(iter(self._parameters.values())))
        groups, size, _ = self.committed.sensors.shape
        self.box = Box(self.search, (groups, size))

    def searched(self, geometry: Geometry, rows: list[Row]) -> np.ndarray:
        """Time-averaged RMSE on the trials and particles of the search, (rows, targets), in m."""
        trials = self.search.first_trial + np.arange(self.search.trials)
        return _averages(self._squared_errors(geometry, rows, trials, self.search.particles))

    def confirmed(
        self, geometry: Geometry, rows: list[Row], particles: int | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """The same on trials that no search has seen, and with one trial left out each.

        (rows, targets) and (trials, rows, targets). `particles` of None are the paper's.
        """
        first = self.search.first_trial + self.search.trials
        trials = first + np.arange(self.search.confirming_trials)
        squared = self._squared_errors(geometry, rows, trials, particles)
        left_out = [metrics.leave_one_out(of_row, mean_of_roots)[:, :-1] for of_row in squared]
        return _averages(squared), np.stack(left_out, axis=1)

    def _squared_errors(
        self, geometry: Geometry, rows: list[Row], trials: np.ndarray, particles: int | None
    ) -> list[np.ndarray]:
        """Squared position errors of each row from k = 1, (trials, K, targets), in m^2."""
        changed = {} if particles is None else {"particles": particles}
        logs, errors = {}, []
        for study, filter_ in rows:
            if study not in logs:
                parameters = geometry.set_in(self._parameters[study])
                logs[study] = simulated(study, POINT, parameters, self.seed, trials)
            _, runs = run(logs[study], filter_, self._settings[study][filter_] | changed)
            errors.append(squared_distance(runs)[:, 1:])
        return errors


def _averages(squared: list[np.ndarray]) -> np.ndarray:
    """Time-averaged RMSE of each row and target, (rows, targets), in m."""
    return np.array([mean_of_roots(of_row.mean(axis=0))[:-1] for of_row in squared])


def misfit(ours: np.ndarray, printed: Printed) -> np.ndarray:
    """Root mean square of ln(ours / printed), over rows and targets: 0.1 is about 10 %."""
    return np.sqrt((arrays.log(ours / printed.values) ** 2).mean(axis=(-2, -1)))
