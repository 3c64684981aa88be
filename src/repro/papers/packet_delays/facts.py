"""Numbers that the reasons for the verdicts on [packet_delays] state."""

from itertools import pairwise

import numpy as np

from repro.papers.packet_delays.claims.errors import largest_error, mean_error, squared_error
from repro.papers.packet_delays.claims.remarks import remark_7_weights
from repro.papers.packet_delays.claims.theorem_1 import claimed_over_true, correlations
from repro.papers.packet_delays.points import (
    CONSTANT_DELAY,
    TRACKING,
    linear_points,
    table_2,
    tracking_point,
)
from repro.statistics import metrics
from repro.studies.linear_delays import COMPONENTS
from repro.tables.results import Results
from repro.verdicts.facts import Fact

Numbers = dict[str, float]
THEIR_TRIALS = 300  # of a cell of Table 2


def _with_losses(results: Results) -> list[tuple[float, str, int]]:
    """p < 1, its point, and the component, for both components."""
    points = linear_points(results)
    return [(p, points[p], i) for p in points if p < 1 for i in range(len(COMPONENTS))]


def _mse(results: Results, point: str, filter_: str, component: int) -> float:
    return float(squared_error(results, point, filter_, component).mean())


def _extremes(name: str, values: list[float]) -> Numbers:
    return {f"{name}_least": min(values), f"{name}_most": max(values)}


def omvf_above_sun(results: Results) -> Numbers:
    """How far the OMVF is above the exact LMMSE filter, in percent, over p < 1."""
    ratios = [
        _mse(results, point, "omvf", i) / _mse(results, point, "sun", i)
        for _, point, i in _with_losses(results)
    ]
    in_rmse = [100 * (ratio**0.5 - 1) for ratio in ratios]
    in_mse = [100 * (ratio - 1) for ratio in ratios]
    return _extremes("above_sun_mse", in_mse) | _extremes("above_sun_rmse", in_rmse)


def sinopoli_better(results: Results) -> Numbers:
    """The p from which on the filter that knows the arrivals is better in both components."""
    worse = [
        p
        for p, point, i in _with_losses(results)
        if _mse(results, point, "omvf", i) < _mse(results, point, "intermittent_kf", i)
    ]
    return {"sinopoli_better_above": max(worse, default=0.0)}


def of_theorem_1(results: Results) -> Numbers:
    """P(k|k) over the true mean square, and the largest correlation that (9) says is zero."""
    ratios = [claimed_over_true(results, point, i)[0] for _, point, i in _with_losses(results)]
    points = {point for _, point, _ in _with_losses(results)}

    def largest(filter_: str) -> float:
        found = [correlations(results, point, filter_) for point in points]
        return max(abs(value) for of_point in found for _, _, (value, _) in of_point)

    late = [
        100 * (_mse(results, CONSTANT_DELAY, "omvf", i) / _mse(results, CONSTANT_DELAY, "genie", i))
        - 100
        for i in range(len(COMPONENTS))
    ]
    return (
        _extremes("claimed_over_true", ratios)
        | {"correlation_omvf": largest("omvf"), "correlation_sun": largest("sun")}
        | _extremes("constant_delay_mse", late)
    )


def worth_of_arrivals(results: Results) -> Numbers:
    """What a filter that knows the arrivals gains over the OMVF (percent) and the EMVF (m)."""
    gains = [
        100 * (_mse(results, point, "omvf", i) / _mse(results, point, "genie", i)) ** 0.5 - 100
        for _, point, i in _with_losses(results)
    ]
    return _extremes("above_genie_rmse", gains) | {
        "median_emvf": float(np.median(mean_error(results, 2, "0.9"))),
        "median_iekf": float(np.median(mean_error(results, 2, "0.9", "iekf"))),
    }


def without_losses(results: Results) -> Numbers:
    """The runs that lose the target at p = 1, where every packet is on time."""
    lost_above = results.analysis(TRACKING).lost_above
    mean, largest = mean_error(results, 1, "1"), largest_error(results, 1, "1", "emvf")
    return {
        "no_loss_lost_percent": 100 * float((largest > lost_above).mean()),
        "no_loss_mean": float(mean.mean()),
        "no_loss_median": float(np.median(mean)),
        "no_loss_small_percent": 100
        * float((largest < results.analysis(TRACKING).small_error).mean()),
    }


def of_table_2(results: Results) -> Numbers:
    """What the cells of Table 2 can decide, and its cell N = 0, p = 0.99."""
    bounds = table_2(results)
    rows = {n: [mean_error(results, n, p) for p in arrivals] for n, arrivals in bounds.items()}
    cells = [cell for row in rows.values() for cell in row]
    of_both = [(1 / len(cell) + 1 / THEIR_TRIALS) ** 0.5 * cell.std(ddof=1) for cell in cells]
    allowed = [
        100 * results.tolerance * float(error / cell.mean())
        for error, cell in zip(of_both, cells, strict=True)
    ]
    columns = [metrics.mean_error(high - low) for low, high in pairwise(rows[max(rows)])]
    beside = [metrics.mean_error(np.subtract(*of_p)) for of_p in zip(rows[0], rows[1], strict=True)]
    suspect = results.parameters(TRACKING, tracking_point(0, bounds[0][-1]))
    no_loss = suspect.arrival_probability**suspect.steps
    return _extremes("match_allows_percent", allowed) | {
        "next_column_undecided": results.tolerance * float(max(columns)),
        "next_row_undecided": results.tolerance * float(max(beside)),
        "without_miss_percent": 100 * no_loss,
        "mean_of_others": 1 / (1 - no_loss),
    }


def of_remark_7(results: Results) -> Numbers:
    """The sum of what Remark 7 takes for probabilities."""
    return {"remark_7_sum": float(remark_7_weights(results).sum())}


FACTS: list[Fact] = [
    omvf_above_sun,
    sinopoli_better,
    of_theorem_1,
    worth_of_arrivals,
    without_losses,
    of_table_2,
    of_remark_7,
]
