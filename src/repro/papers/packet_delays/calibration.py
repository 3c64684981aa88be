"""How far packet_delays Table 2 is from what each value of the unstated parameters gives.

What was fitted: the turn-rate variance q that the EMVF assumes, the channel, and S(0). Fitted to:
the 15 mean errors of Table 2.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field

from repro import plugins
from repro.kernels import arrays
from repro.papers.packet_delays.points import TRACKING
from repro.parameters.values import NotNegative, Values
from repro.runner import run
from repro.simulate import simulated
from repro.statistics import metrics
from repro.studies.wsn_tracking import position_error
from repro.tables.csv_file import write_csv
from repro.verdicts.published import read_published

FILTER, METRIC = "emvf", "saee"


class Grid(Values):
    """Values that are tried: section `calibration` of the parameter file."""

    turn_rate_variances: Annotated[
        tuple[NotNegative, ...], Field(min_length=1, description="(rad/s)^2 per step, q")
    ]
    channels: Annotated[tuple[Literal["lossy", "eq2"], ...], Field(min_length=1)]
    initial_second_moments: Annotated[
        tuple[Literal["theorem_2", "P0", "matched"], ...],
        Field(min_length=1, description="S(0)"),
    ]
    trials: Annotated[int, Field(ge=2, description="trials of each cell of Table 2")]
    first_trial: Annotated[int, Field(ge=0, description="first trial number; tables have others")]

    def with_budget(self, budget: float) -> Self:
        """The same grid for a share of the effort: the root of it in trials."""
        return self.model_copy(update={"trials": max(2, round(budget**0.5 * self.trials))})


def printed_cells(published: str | Path) -> dict[str, float]:
    """Table 2: SAEE in m by point."""
    rows = read_published(published)
    rows = rows[(rows["kind"] == "value") & (rows["metric"] == METRIC)]
    return {point: float(value) for point, value in zip(rows["point"], rows["value"], strict=True)}


def tabulate(
    points: Mapping[str, Mapping[str, Any]],
    grid: Grid,
    printed: Mapping[str, float],
    seed: int,
    tolerance: float,
    path: str | Path,
) -> None:
    """Write the misfit to Table 2 for every combination of the grid, on the same trials.

    The misfit is the root mean square of ln(ours / printed) over the cells: 0.1 is about 10 %.
    `equal` says whether it is within `tolerance` standard errors of its paired difference from
    the smallest. `points` have, by name, parameters and settings of the filters as JSON has them.
    """
    target, found = np.array([*printed.values()]), []
    chosen = _chosen(points[next(iter(printed))])
    for channel in grid.channels:
        for variance in grid.turn_rate_variances:
            changed = {"channel": channel, "turn_rate_variance": variance}
            cells = [_mean_errors(name, points[name], changed, grid, seed) for name in printed]
            for i, moment in enumerate(grid.initial_second_moments):
                combination = changed | {"initial_second_moment": moment}
                errors = np.stack([cell[i] for cell in cells], axis=1)  # (trials, cells)
                ratio = arrays.log(errors.mean(axis=0) / target)
                left_out = arrays.log(metrics.leave_one_out(errors, lambda rest: rest) / target)
                row = combination | {"chosen": combination == chosen}
                row |= {"misfit": float(_root_mean_square(ratio))}
                row |= {"noise": float(_root_mean_square(metrics.jackknife_error(left_out)))}
                row |= {"level": float(ratio.mean())}
                found.append((row, _root_mean_square(left_out)))
    best, best_left_out = min(found, key=lambda of: of[0]["misfit"])
    rows = []
    for row, left_out in found:
        worse = row["misfit"] - best["misfit"]
        error = float(metrics.jackknife_error(left_out - best_left_out))
        row |= {"mcse": float(metrics.jackknife_error(left_out))}
        row |= {"worse_than_best": worse, "mcse_of_difference": error}
        rows.append(row | {"equal": worse <= tolerance * error, "trials": grid.trials})
    write_csv(rows, path)


def _chosen(point: Mapping[str, Any]) -> dict[str, Any]:
    """What the parameter file has chosen."""
    parameters = {key: point["parameters"][key] for key in ("channel", "turn_rate_variance")}
    moment = "initial_second_moment"
    return parameters | {moment: point["filters"][FILTER][moment]}


def _mean_errors(
    name: str, point: Mapping[str, Any], changed: Mapping[str, Any], grid: Grid, seed: int
) -> list[np.ndarray]:
    """Mean position error of each trial under each S(0), [(trials,)], in m."""
    parameters = plugins.study(TRACKING).Parameters.checked(point["parameters"] | changed, name)
    trials = grid.first_trial + np.arange(grid.trials)
    log = simulated(TRACKING, name, parameters, seed, trials)
    found = []
    for moment in grid.initial_second_moments:
        settings = point["filters"][FILTER] | {"initial_second_moment": moment}
        found.append(position_error(run(log, FILTER, settings)[1])[:, 1:].mean(axis=1))
    return found


def _root_mean_square(of_cells: np.ndarray) -> np.ndarray:
    """Over the last axis."""
    return np.sqrt((of_cells**2).mean(axis=-1))
