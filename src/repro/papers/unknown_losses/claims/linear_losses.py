"""Claims on the linear system [unknown_losses Sec. V, VI-A, Fig. 1]."""

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np

from repro.kernels import arrays
from repro.papers.unknown_losses.points import most_runs, proposed_filters, swept
from repro.statistics.metrics import Jackknife
from repro.statistics.runs import Runs
from repro.studies import linear_losses
from repro.studies.linear_losses import Analysis
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, smaller
from repro.verdicts.equivalence import equivalent
from repro.verdicts.rmse import negative, smaller_rmse

CLAIMS: list[Claim] = []
STUDY = "linear_losses"


def thresholds(results: Results) -> Analysis:
    """Of the claims below."""
    return results.analysis(STUDY)


def linear(results: Results, point: str, filter_: str, average: bool = False) -> Jackknife:
    """The RMSE, summed over the steps, or their mean."""
    return results.rmse(STUDY, point, filter_, linear_losses.squared_error, average)


def filters_over_p(results: Results) -> Iterator[tuple[float, str, str]]:
    """Loss probability, point and name of each of the paper's filters at each p of Fig. 1."""
    for p, point in swept(results.catalogue, STUDY).items():
        for name in proposed_filters(results.catalogue, STUDY, point):
            yield p, point, name


@claim(
    CLAIMS,
    "ikf-is-best",
    "Fig. 1: the IKF has a smaller RMSE than BKF-I, BKF-II and RBPF at every p",
)
def ikf_is_best(results: Results) -> list[Part]:
    return [
        smaller_rmse(
            f"p={p}: iekf - {name}", linear(results, point, "iekf"), linear(results, point, name)
        )
        for p, point, name in filters_over_p(results)
    ]


@claim(
    CLAIMS,
    "filters-below-kf",
    "Fig. 1: BKF-I, BKF-II and RBPF have a smaller RMSE than the KF that ignores the losses",
)
def better_than_ignoring_losses(results: Results) -> list[Part]:
    return [
        smaller_rmse(
            f"p={p}: {name} - ekf", linear(results, point, name), linear(results, point, "ekf")
        )
        for p, point, name in filters_over_p(results)
    ]


@claim(
    CLAIMS,
    "filters-much-below-kf",
    "Sec. VI-A: the RMSE of BKF-I, BKF-II and RBPF is much smaller than that of the KF at every p",
)
def much_better_than_ignoring_losses(results: Results) -> list[Part]:
    factor = thresholds(results).much_better_by
    return [
        negative(
            f"p={p}: {factor:g} times {name} - ekf",
            lambda rmse, worst: factor * rmse - worst,
            *(linear(results, point, filter_) for filter_ in (name, "ekf")),
        )
        for p, point, name in filters_over_p(results)
    ]


def close_to_ikf(results: Results, filter_: str) -> list[Part]:
    """The filter's RMSE is that of the IKF but for a factor, at each p of Fig. 1."""
    margin, parts = arrays.log(thresholds(results).close_within), []
    for p, point in most_runs(results.catalogue, STUDY).items():
        ratio = negative(
            f"p={p}: log of RMSE of {filter_} over the IKF's",
            lambda rmse, best: arrays.log(rmse / best),
            *(linear(results, point, name) for name in (filter_, "iekf")),
        )
        parts += equivalent(ratio.name, ratio.difference, ratio.mcse, margin)
    return parts


@claim(CLAIMS, "bkf-1-close-to-ikf", "Fig. 1: the RMSE of BKF-I is close to the IKF's at every p")
def bkf_1_is_close(results: Results) -> list[Part]:
    return close_to_ikf(results, "bkf_1")


@claim(CLAIMS, "bkf-2-close-to-ikf", "Fig. 1: the RMSE of BKF-II is close to the IKF's at every p")
def bkf_2_is_close(results: Results) -> list[Part]:
    return close_to_ikf(results, "bkf_2")


@claim(CLAIMS, "rbpf-close-to-ikf", "Fig. 1: the RMSE of the RBPF is close to the IKF's at every p")
def rbpf_is_close(results: Results) -> list[Part]:
    return close_to_ikf(results, "rbpf")


def gain_grows(results: Results, gain: Callable) -> list[Part]:
    """gain(RMSE of the KF, RMSE of the filter) grows from each p to the next."""
    points = swept(results.catalogue, STUDY)
    return [
        negative(
            f"{name}: gain at p={low} - p={high}",
            lambda kf_low, rmse_low, kf_high, rmse_high: (
                gain(kf_low, rmse_low) - gain(kf_high, rmse_high)
            ),
            *(linear(results, points[p], f) for p in (low, high) for f in ("ekf", name)),
        )
        for name in proposed_filters(results.catalogue, STUDY, next(iter(points.values())))
        for low, high in pairwise(points)
    ]


@claim(
    CLAIMS,
    "gain-grows-as-difference",
    "Fig. 1: the gain over the KF, as a difference, grows with p",
)
def difference_grows(results: Results) -> list[Part]:
    return gain_grows(results, lambda kf, rmse: kf - rmse)


@claim(CLAIMS, "gain-grows-as-ratio", "Fig. 1: the gain over the KF, as a ratio, grows with p")
def ratio_grows(results: Results) -> list[Part]:
    return gain_grows(results, lambda kf, rmse: kf / rmse)


@claim(
    CLAIMS,
    "rbpf-limit-is-ikf",
    "Sec. V-A: with more particles the RBPF comes arbitrarily near the IKF",
)
def rbpf_approaches_ikf(results: Results) -> list[Part]:
    return [
        smaller_rmse(
            f"p={p}: limit of the RBPF (exact) - iekf",
            linear(results, point, "exact"),
            linear(results, point, "iekf"),
        )
        for p, point in swept(results.catalogue, STUDY, "short-loss=").items()
    ]


@claim(
    CLAIMS,
    "rbpf-limit-is-exact-estimate",
    "Introduction: the RBPF approximates the estimate without knowledge of the losses",
)
def rbpf_approaches_exact(results: Results) -> list[Part]:
    closer, parts = thresholds(results).limit_nearer_by, []
    for point in swept(results.catalogue, STUDY, "short-loss=").values():
        errors = {
            name: results.runs(STUDY, point, name).error
            for name in ("exact", "rbpf", "rbpf_fast", "bkf_2")
        }
        distance = {
            name: (((error - errors["exact"]) ** 2).sum(axis=-1)).mean(axis=1)
            for name, error in errors.items()
        }
        many, few = distance["rbpf_fast"], distance["rbpf"]  # as the point sets their particles
        named = "squared distance to exact: rbpf_fast, of more particles"
        parts.append(smaller(f"{named} - that of rbpf / {closer:g}", many, few / closer))
        parts.append(smaller(f"{named} - that of bkf_2", many, distance["bkf_2"]))
    return parts


@claim(CLAIMS, "ikf-is-stable", "Sec. VI-A: the IKF is mean-square stable for every p < 1")
def ikf_is_stable(results: Results) -> list[Part]:
    """Its mean squared error does not grow from the third quarter of the steps to the last.

    In a linear system it is the mean of the variances that the IKF claims, which vary less over
    the runs than its squared errors.
    """
    factor, parts = thresholds(results).bounded_within, []

    def mean_square(runs: Runs, quarter: int) -> np.ndarray:
        assert runs.claimed is not None
        variance = runs.claimed.sum(axis=-1)
        steps = variance.shape[1]
        return variance[:, quarter * steps // 4 : (quarter + 1) * steps // 4].mean(axis=1)

    for p, point in swept(results.catalogue, STUDY).items():
        third, last = (
            results.each(
                STUDY, point, "iekf", lambda runs, quarter=quarter: mean_square(runs, quarter)
            )
            for quarter in (2, 3)
        )
        parts.append(
            smaller(f"p={p}: last quarter - {factor:g} third quarter", last, factor * third)
        )
    return parts
