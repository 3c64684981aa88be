"""The Python interface, for a notebook or a debugger: no Snakemake, no file.

`import repro` gives its functions: repro.study, repro.run, repro.estimate, repro.compare.
"""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from repro import plugins
from repro.errors import ReproError, computing
from repro.logs import Log
from repro.network.channels import Recorded
from repro.parameters.load import Paper, Point, load_paper, load_run
from repro.parameters.settings import typed_settings
from repro.runner import build
from repro.runner import run as run_on_log
from repro.runner.block import Block
from repro.runner.faults import Task
from repro.simulate import simulated
from repro.statistics import metrics
from repro.statistics.paired import decided
from repro.statistics.runs import Runs
from repro.statistics.shards import Columns
from repro.streams import Streams
from repro.studies import ClosedLoop
from repro.workflow.memory_and_disk import check_memory

FILTERS = "repro.filters"
PARAMETERS = Path(__file__).resolve().parents[3] / "params"


class Estimates(NamedTuple):
    """What a filter makes of a log: arrays (trials, steps, n), errors NaN without a truth."""

    label: str
    estimate: np.ndarray
    error: np.ndarray
    runs: Runs  # with claimed variances and what the filter recorded besides
    squared_error: np.ndarray  # of what the study is about, (trials, steps)


class StudyAtPoints:
    """A study with the points that its parameter file gives it."""

    def __init__(self, name: str):
        self.name, self.scenario = name, plugins.study(name)

    def __repr__(self) -> str:
        return f"<study {self.name}: {', '.join(self.points)}>"

    @property
    def points(self) -> dict[str, Point]:
        """Parameters and settings by the name of the point."""
        return paper_of(self.name).studies[self.name]

    def simulate(
        self, point: str, trials: int | None = None, seed: int | None = None, **changes: Any
    ) -> Log:
        """A log in memory; `changes` are other values of the point's parameters.

        The same trials as the workflow's, unless `seed` is another than its root seed. Raises
        ReproError for an unknown point or parameter, and for a value that does not fit.
        """
        parameters = self.point(point).parameters
        if trials is not None:
            changes["trials"] = trials
        where = f"{self.name}, {point}"
        parameters = self.scenario.Parameters.checked(parameters.plain() | changes, where)
        check_memory(self.name, point, parameters)
        root_seed = load_run(PARAMETERS / "run.yaml", {}).root_seed if seed is None else seed
        with computing(where):
            return simulated(self.name, point, parameters, root_seed, np.arange(parameters.trials))

    def model(self, point: str) -> Any:
        """What a filter knows of system and network at a point."""
        return self.scenario.model(self.point(point).parameters)

    def point(self, name: str) -> Point:
        """A point by its name. Raises ReproError if there is none."""
        if name not in self.points:
            raise ReproError(
                f"{self.name}: no point '{name}'; the points are {', '.join(self.points)}"
            )
        return self.points[name]


@cache
def paper_of(study: str) -> Paper:
    """The parameters of the paper that a study is of. Raises ReproError if no file has it."""
    for file in sorted(PARAMETERS.glob("*.yaml")):
        if file.name != "run.yaml":
            paper = load_paper(file)
            if study in paper.studies:
                return paper
    raise ReproError(f"study {study}: no file in {PARAMETERS} has its points")


def study(name: str) -> StudyAtPoints:
    """A study by its name. Raises ReproError if there is none."""
    return StudyAtPoints(name)


def run(filter_: Any, log: Log, **settings: Any) -> Estimates:
    """A filter on a log: given by its name, as a module, or as any object with LABEL, SEES, build.

    Settings that are not given are those that the log's point has for a filter of this package,
    else their defaults. Raises ReproError in one line.
    """
    name, module = plugins.named_filter(filter_)
    known: Mapping[str, Any] = {}
    if isinstance(filter_, str) or getattr(module, "__name__", "") == f"{FILTERS}.{name}":
        of_point = paper_of(log.study).studies[log.study].get(log.point)
        known = of_point.filters.get(name, {}) if of_point else {}
    estimate, runs = run_on_log(log, filter_, known | settings)
    squared = plugins.study(log.study).squared_error(runs)
    return Estimates(module.LABEL, estimate, runs.error, runs, squared)


def estimate(
    filter_: Any,
    model: Any,
    received: np.ndarray,
    arrival: np.ndarray | None = None,
    *,
    first_step: int = 1,
    seed: int = 0,
    settings: Mapping[str, Any] | None = None,
    **channels: np.ndarray,
) -> np.ndarray:
    """Estimates (trials, steps, n), or (steps, n) of a single record, from plain arrays.

    `received` is (steps,) or (steps, m) of a single record, or (trials, steps, ...); `arrival` is
    (steps,) or (trials, steps). Further channels are given by name and have a leading axis of
    trials only if `received` has. Row 0 belongs to the initial state: it is used only if
    `first_step` is 0. Raises ReproError.
    """
    name, module = plugins.named_filter(filter_)
    task = Task(name, "plain arrays")
    if not hasattr(model, "initial_mean"):
        raise ReproError(f"{task}: the model, a {type(model).__name__}, has no initial_mean")
    given = {"received": received, "arrival": arrival, **channels}
    arrays = {key: _array(task, key, value) for key, value in given.items() if value is not None}
    single = arrays["received"].ndim < 3
    if single:
        arrays = {key: value[None] for key, value in arrays.items()}
        arrays["received"] = arrays["received"].reshape(*arrays["received"].shape[:2], -1)
    _check_shapes(task, arrays, single)
    trials, steps, *_ = arrays["received"].shape
    numbers = np.arange(trials)
    stream = plugins.stream_of(name, module)
    block = Block(
        task,
        build(task, module, model, typed_settings(module, name, settings or {}, str(task))),
        module.SEES,
        Recorded(**arrays),
        Streams(seed, "plain arrays", stream, numbers.tolist()),
        numbers,
        steps=steps,
        states=len(model.initial_mean),
        first_step=first_step,
    )
    estimated = block.run().estimate
    return estimated[0] if single else estimated


def _array(task: Task, channel: str, value: Any) -> np.ndarray:
    """A channel as an array of numbers, (steps, ...) at least."""
    try:
        array = np.asarray(value)
        if channel in ("received", "arrival") or array.dtype.kind not in "iu":
            array = array.astype(float)  # codes stay integers
    except (TypeError, ValueError) as error:
        raise ReproError(f"{task}: {channel} is not an array of numbers: {error}") from None
    if array.ndim == 0:
        raise ReproError(f"{task}: {channel} is a single number; it must be (steps, ...)")
    return array


def _check_shapes(task: Task, arrays: Mapping[str, np.ndarray], single: bool) -> None:
    """Raises ReproError unless all channels have the trials and steps of what is received."""
    wanted = arrays["received"].shape[:2]
    shapes = ", ".join(f"{name} {value.shape[single:]}" for name, value in arrays.items())
    if any(value.shape[:2] != wanted for value in arrays.values()):
        raise ReproError(f"{task}: the channels differ in trials or steps: {shapes}")
    if "arrival" in arrays and arrays["arrival"].ndim != 2:
        leading = "(steps,)" if single else "(trials, steps)"
        raise ReproError(f"{task}: arrival must be {leading}: {shapes}")


def compare(filters: Mapping[str, Any], log: Log, tolerance: float | None = None) -> pd.DataFrame:
    """Filters on one log, the best first, with paired differences to the best.

    `filters` maps a name of one's choice to a filter (see `run`), or to a filter and its settings.
    Columns: rmse (mean over k of the root of the mean squared error over the trials) with its
    standard error, median of the single runs, the difference to the best with its paired standard
    error, and the verdict at `tolerance` standard errors (by default that of
    params/run.yaml): best, worse, not decided.
    """
    if not filters:
        raise ReproError("compare: no filter is given")
    if "/truth" not in log.values and not isinstance(plugins.study(log.study), ClosedLoop):
        raise ReproError("compare: the log has no /truth, so there are no errors to compare")
    given = {} if tolerance is None else {"tolerance": float(tolerance)}
    tolerance = load_run(PARAMETERS / "run.yaml", given).tolerance
    found = {}
    for name, entry in filters.items():
        filter_, settings = entry if isinstance(entry, tuple) else (entry, {})
        squared = run(filter_, log, **settings).squared_error
        found[name] = metrics.roots_over_steps(Columns(iter([squared]), [len(squared)]))
    best = min(found, key=lambda name: found[name].value)
    rows = []
    for name, number in sorted(found.items(), key=lambda item: item[1].value):
        statistic = metrics.statistic(number)
        difference = number.value - found[best].value
        error = float(metrics.jackknife_error(number.left_out - found[best].left_out))
        rows.append(
            {"filter": name, "rmse": statistic.value, "mcse": statistic.mcse}
            | {"median": statistic.median, "difference": difference, "difference_mcse": error}
            | {"verdict": "best" if name == best else decided(difference, error, tolerance)}
        )
    return pd.DataFrame(rows).set_index("filter")
