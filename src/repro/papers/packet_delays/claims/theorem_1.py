"""Claims of the derivation of the OMVF [packet_delays Lemma 2, Theorem 1, Remark 3]."""

import numpy as np

from repro.papers.packet_delays.claims.errors import equal, squared_error
from repro.papers.packet_delays.points import CONSTANT_DELAY, LINEAR, linear_points
from repro.statistics import metrics
from repro.studies.linear_delays import COMPONENTS
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim
from repro.verdicts.equivalence import equivalent

CLAIMS: list[Claim] = []


@claim(
    CLAIMS,
    "omvf-error-orthogonal-to-received",
    "Lemma 2, (9): for p < 1 the OMVF's error at k is uncorrelated with y(k), y(k-1), ...",
)
def omvf_error_orthogonal_to_received(results: Results) -> list[Part]:
    margin = results.analysis(LINEAR).orthogonal_within
    return [
        part
        for arrival, point in linear_points(results).items()
        if arrival < 1
        for lag, component, (value, error) in correlations(results, point, "omvf")
        for part in equivalent(
            f"p={arrival}: correlation of the error of {component} with y(k-{lag})",
            value,
            error,
            margin,
        )
    ]


@claim(
    CLAIMS,
    "omvf-covariance-is-its-error",
    "Theorem 1, (15): for p < 1 P(k|k) is the covariance of the OMVF's error",
)
def omvf_covariance_is_its_error(results: Results) -> list[Part]:
    margin = results.analysis(LINEAR).covariance_within
    return [
        part
        for arrival, point in linear_points(results).items()
        if arrival < 1
        for i, component in enumerate(COMPONENTS)
        for ratio, error in [claimed_over_true(results, point, i)]
        for part in equivalent(
            f"p={arrival}, {component}: claimed over true mean squared error, {ratio:.3f}, less 1",
            ratio - 1.0,
            error,
            margin,
        )
    ]


@claim(
    CLAIMS,
    "omvf-optimal-at-constant-delay",
    "Theorem 1, Remark 3: where every packet is N steps late, the OMVF is the optimal filter",
)
def omvf_optimal_at_constant_delay(results: Results) -> list[Part]:
    first, second = (
        results.runs(LINEAR, CONSTANT_DELAY, filter_).error for filter_ in ("omvf", "genie")
    )
    return [equal("errors", first, second, results.analysis(LINEAR).equal_within)]


def correlations(
    results: Results, point: str, filter_: str
) -> list[tuple[int, str, tuple[float, float]]]:
    """Correlation of the error at k and y(k-lag), with its standard error, for lags up to N."""
    error = results.runs(LINEAR, point, filter_).error
    log = results.log(LINEAR, point)
    y, lags = log.field("/received", "y"), range(log.parameters.packet_bound + 1)
    late = error[:, len(lags) :]  # y(0) is not received
    return [
        (lag, component, _correlation(late[..., i], y[:, len(lags) - lag : y.shape[1] - lag]))
        for lag in lags
        for i, component in enumerate(COMPONENTS)
    ]


def _correlation(first: np.ndarray, second: np.ndarray) -> tuple[float, float]:
    """Correlation of two quantities of mean zero, (trials, steps), with its jackknife error."""
    of_trials = np.stack([first * second, first**2, second**2]).mean(axis=-1)

    def of(mean: np.ndarray) -> np.ndarray:
        return mean[0] / np.sqrt(mean[1] * mean[2])

    total = of_trials.sum(axis=1)
    left_out = of((total[:, None] - of_trials) / max(of_trials.shape[1] - 1, 1))
    return float(of(of_trials.mean(axis=1))), float(metrics.jackknife_error(left_out))


def claimed_over_true(results: Results, point: str, component: int) -> tuple[float, float]:
    """The OMVF's P(k|k) over its mean squared error, both means over k, and the standard error."""
    claimed = results.in_shards(LINEAR, point, "omvf").first.claimed
    assert claimed is not None  # the same in every trial
    claim_ = claimed[1:, component].mean()
    squared = squared_error(results, point, "omvf", component)
    left_out = metrics.leave_one_out(squared, lambda mean: claim_ / mean)
    return float(claim_ / squared.mean()), float(metrics.jackknife_error(left_out))
