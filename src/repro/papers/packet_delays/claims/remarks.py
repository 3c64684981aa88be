"""Claims of the remarks on OMVF and EMVF [packet_delays Remarks 2, 3, 5, 7]."""

from itertools import pairwise

import numpy as np

from repro.papers.packet_delays.claims.errors import (
    compared,
    equal,
    largest_error,
    squared_error,
)
from repro.papers.packet_delays.points import LINEAR, TRACKING, linear_points
from repro.studies.linear_delays import COMPONENTS
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, most, smaller

CLAIMS: list[Claim] = []
HORIZON = 20  # steps after which the OMVF's estimate is put as a function of all y received


@claim(
    CLAIMS,
    "omvf-needs-no-arrivals",
    "Remark 2: the OMVF needs the arrival probability, not the arrivals: with p given, its "
    "estimate is one linear function of y(1) ... y(k), whatever arrives when",
)
def omvf_needs_no_arrivals(results: Results) -> list[Part]:
    """The function is fitted on half of the runs, and holds on the other half up to rounding."""
    relative = results.analysis(LINEAR).equal_within
    return [
        equal(f"p={arrival}: estimates at k={HORIZON}", *from_received(results, point), relative)
        for arrival, point in linear_points(results).items()
    ]


@claim(
    CLAIMS,
    "emvf-needs-no-arrivals",
    "Remark 5: the arrival probability is enough: the EMVF, which sees the y of the EKF and p, "
    "has the smaller largest error in most runs",
)
def emvf_needs_no_arrivals(results: Results) -> list[Part]:
    return [
        most(
            f"N={bound}, p={arrival}: largest error of the EMVF below the EKF's",
            largest_error(results, bound, arrival, "emvf")
            < largest_error(results, bound, arrival, "ekf"),
        )
        for arrival in ("0.95", "0.9")
        for bound in (1, 2)
    ]


@claim(
    CLAIMS,
    "omvf-approaches-kalman",
    "Remark 3: as p rises to 1, the error of the OMVF falls to that of the Kalman filter",
)
def omvf_approaches_kalman(results: Results) -> list[Part]:
    return [
        smaller(
            f"{component}: mean squared error at p={high} - p={low}",
            squared_error(results, points[high], "omvf", i),
            squared_error(results, points[low], "omvf", i),
        )
        for points in [linear_points(results)]
        for low, high in pairwise(points)
        for i, component in enumerate(COMPONENTS)
    ]


@claim(
    CLAIMS,
    "omvf-equals-kalman-without-losses",
    "Remark 3: at p = 1 the OMVF is the Kalman filter",
)
def omvf_equals_kalman_without_losses(results: Results) -> list[Part]:
    point = linear_points(results)[1.0]
    first, second = (
        results.runs(LINEAR, point, filter_).error for filter_ in ("omvf", "intermittent_kf")
    )
    return [equal("errors", first, second, results.analysis(LINEAR).equal_within)]


@claim(CLAIMS, "emvf-equals-ekf-without-losses", "Remark 3: at p = 1 the EMVF is the EKF")
def emvf_equals_ekf_without_losses(results: Results) -> list[Part]:
    first, second, tracked = compared(results, (1, "emvf"), (1, "ekf"))
    relative = results.analysis(TRACKING).equal_within
    name = f"errors of the {tracked.sum()} of {len(tracked)} runs that track"
    return [equal(name, first[tracked], second[tracked], relative)]


@claim(
    CLAIMS,
    "remark-7-weights-are-probabilities",
    "Remark 7: the delays may have the probabilities 1 / (N + 1 - i), 0 <= i <= N",
)
def remark_7_weights_are_probabilities(results: Results) -> list[Part]:
    relative = results.analysis(LINEAR).equal_within
    total = remark_7_weights(results).sum()
    return [below("sum of the probabilities", total, 1.0 + relative)]


def remark_7_weights(results: Results) -> np.ndarray:
    """The mean weights alpha_i that Remark 7 prints, (N + 1,)."""
    *_, point = linear_points(results).values()
    bound = results.parameters(LINEAR, point).packet_bound
    return 1.0 / (bound + 1 - np.arange(bound + 1))


def from_received(results: Results, point: str) -> tuple[np.ndarray, np.ndarray]:
    """OMVF's estimates of the second half of the runs: as a function of y, and its own."""
    log = results.log(LINEAR, point)
    y = log.field("/received", "y")[:, 1 : HORIZON + 1]
    error = results.runs(LINEAR, point, "omvf").error[:, HORIZON]
    estimate = log.values["/truth"][:, HORIZON] + error
    half = len(y) // 2
    function = np.linalg.lstsq(y[:half], estimate[:half], rcond=None)[0]
    return y[half:] @ function, estimate[half:]
