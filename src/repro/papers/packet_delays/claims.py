"""Claims of [packet_delays]: its Tables 1-2, Figures 1-10 and the text on them."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from repro.filters import emvf, omvf
from repro.papers.packet_delays.points import (
    LINEAR,
    TRACKING,
    linear_points,
    missed_packets,
    table_2,
    tracking_point,
)
from repro.statistics.runs import Runs
from repro.studies import linear_delays, wsn_tracking
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, most, smaller

CLAIMS: list[Claim] = []


def of_each_run(
    results: Results, study: str, point: str, filter_: str, quantity: Callable[[Runs], np.ndarray]
) -> np.ndarray:
    """One number of each run, (trials,)."""
    numbers = results.each(study, point, filter_, quantity)
    assert isinstance(numbers, np.ndarray)
    return numbers


def mean_error(results: Results, bound: int, arrival: str) -> np.ndarray:
    """Mean position error of each run of the EMVF, whose mean is SAEE, (trials,), in m."""
    return of_each_run(
        results,
        TRACKING,
        tracking_point(bound, arrival),
        "emvf",
        lambda runs: wsn_tracking.position_error(runs)[:, 1:].mean(axis=1),
    )


def largest_error(results: Results, bound: int, arrival: str, filter_: str) -> np.ndarray:
    """Largest position error of each run, (trials,), in m."""
    return of_each_run(
        results,
        TRACKING,
        tracking_point(bound, arrival),
        filter_,
        lambda runs: wsn_tracking.position_error(runs)[:, 1:].max(axis=1),
    )


def number_missed(results: Results, bound: int, arrival: str) -> np.ndarray:
    """Number of steps of each run whose packet is late or lost, (trials,)."""
    return results.each_log(
        TRACKING, tracking_point(bound, arrival), lambda log: missed_packets(log).sum(axis=1)
    )


def squared_error(results: Results, point: str, filter_: str, component: int) -> np.ndarray:
    """Mean squared error of each run, (trials,)."""
    return of_each_run(
        results,
        LINEAR,
        point,
        filter_,
        lambda runs: (runs.error[:, 1:, component] ** 2).mean(axis=1),
    )


def more_accurate(results: Results, first: str, second: str) -> list[Part]:
    """`first` has the smaller mean squared error in every component and at every p < 1."""
    return [
        smaller(
            f"{component}, p={arrival}: {first} - {second}",
            squared_error(results, point, first, i),
            squared_error(results, point, second, i),
        )
        for arrival, point in linear_points(results).items()
        if arrival < 1
        for i, component in enumerate(linear_delays.COMPONENTS)
    ]


def equal(name: str, first: np.ndarray, second: np.ndarray, relative: float) -> Part:
    """Errors that must agree do so up to rounding, `relative` to the largest (or to 1)."""
    allowed = relative * max(1.0, np.abs(second).max())
    return below(name, np.abs(first - second).max(), allowed)


def compared(
    results: Results, first: tuple[int, str], second: tuple[int, str]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Errors of two of (N, filter) without losses, and the runs that neither loses, (trials,).

    Once the target is lost, rounding grows without bound.
    """
    analysis = results.analysis(TRACKING)
    runs = [
        results.runs(TRACKING, tracking_point(bound, "1"), filter_)
        for bound, filter_ in (first, second)
    ]
    lost = [wsn_tracking.STUDY.lost(each, analysis) for each in runs]
    return runs[0].error, runs[1].error, ~(lost[0] | lost[1])


@claim(
    CLAIMS,
    "saee-falls-with-arrival-probability",
    "Table 2: SAEE falls as the arrival probability rises, for every N",
)
def saee_falls_with_arrival_probability(results: Results) -> list[Part]:
    return [
        smaller(
            f"N={bound}: SAEE at p={high} - p={low}",
            mean_error(results, bound, high),
            mean_error(results, bound, low),
        )
        for bound, arrivals in table_2(results).items()
        for low, high in pairwise(arrivals)
    ]


@claim(
    CLAIMS,
    "saee-falls-with-packet-bound",
    "Table 2: SAEE falls as N rises, at every arrival probability",
)
def saee_falls_with_packet_bound(results: Results) -> list[Part]:
    bounds = table_2(results)
    return [
        smaller(
            f"p={arrival}: SAEE at N={more} - N={less}",
            mean_error(results, more, arrival),
            mean_error(results, less, arrival),
        )
        for arrival in bounds[0]
        for less, more in pairwise(bounds)
    ]


@claim(
    CLAIMS,
    "small-errors-without-losses",
    "Figs. 3-4: at p = 1 the errors of EKF and EMVF stay small",
)
def small_errors_without_losses(results: Results) -> list[Part]:
    bound_of_error = results.analysis(TRACKING).small_error
    return [
        most(
            f"N={bound}, {filter_}: largest error < {bound_of_error:g} m",
            largest_error(results, bound, "1", filter_) < bound_of_error,
        )
        for bound, filter_ in ((1, "ekf"), (1, "emvf"), (2, "emvf"))
    ]


@claim(
    CLAIMS,
    "emvf-independent-of-packet-bound-without-losses",
    "Fig. 4: at p = 1 the EMVF is the same for N = 1 and N = 2",
)
def emvf_independent_of_packet_bound(results: Results) -> list[Part]:
    first, second, tracked = compared(results, (1, "emvf"), (2, "emvf"))
    relative = results.analysis(TRACKING).equal_within
    return [
        equal("errors of the runs that track", first[tracked], second[tracked], relative),
        most("runs that track", tracked),
    ]


@claim(
    CLAIMS,
    "emvf-below-ekf-after-missed-packet",
    "Figs. 5-6: at p = 0.98 the error of the EKF after a missed packet is above the EMVF's",
)
def emvf_below_ekf_after_missed_packet(results: Results) -> list[Part]:
    missed = number_missed(results, 1, "0.98") > 0
    return [
        most(
            f"N={bound}: largest error of the EMVF below the EKF's, runs with a missed packet",
            (
                largest_error(results, bound, "0.98", "emvf")
                < largest_error(results, bound, "0.98", "ekf")
            )[missed],
        )
        for bound in (1, 2)
    ]


@claim(
    CLAIMS, "emvf-tracks-with-few-losses", "Figs. 5-6: at p = 0.98 the EMVF still tracks the target"
)
def emvf_tracks_with_few_losses(results: Results) -> list[Part]:
    lost_above = results.analysis(TRACKING).lost_above
    return [
        most(
            f"N={bound}: largest error < {lost_above:g} m",
            largest_error(results, bound, "0.98", "emvf") < lost_above,
        )
        for bound in (1, 2)
    ]


@claim(
    CLAIMS,
    "ekf-loses-target-with-more-losses",
    "Text on Figs. 7-10: at p = 0.95 and 0.90 the EKF loses the target",
)
def ekf_loses_target_with_more_losses(results: Results) -> list[Part]:
    lost_above = results.analysis(TRACKING).lost_above
    return [
        most(
            f"N={bound}, p={arrival}: largest error of the EKF > {lost_above:g} m",
            largest_error(results, bound, arrival, "ekf") > lost_above,
        )
        for arrival in ("0.95", "0.9")
        for bound in (1, 2)
    ]


@claim(
    CLAIMS,
    "emvf-better-with-larger-packet-bound",
    "Figs. 7-10: at p = 0.95 and 0.90 the EMVF tracks better with N = 2 than with N = 1",
)
def emvf_better_with_larger_packet_bound(results: Results) -> list[Part]:
    return [
        most(
            f"p={arrival}: largest error smaller with N=2",
            largest_error(results, 2, arrival, "emvf") < largest_error(results, 1, arrival, "emvf"),
        )
        for arrival in ("0.95", "0.9")
    ]


@claim(
    CLAIMS,
    "figure-10-is-typical",
    "Fig. 10: its largest errors are typical of runs that miss as many packets",
)
def figure_10_is_typical(results: Results) -> list[Part]:
    analysis = results.analysis(TRACKING)
    number, (lowest, highest) = analysis.figure_10_missed_packets, analysis.typical_quantiles
    parts = []
    for bound, printed in analysis.figure_10_largest_errors.items():
        comparable = number_missed(results, bound, "0.9") == number
        errors = largest_error(results, bound, "0.9", "emvf")[comparable]
        quantile = (errors < np.mean(printed)).mean()
        error = np.sqrt(quantile * (1 - quantile) / len(errors))
        name = (
            f"N={bound}: {_range(printed)} is quantile {quantile:.3f} "
            f"of {len(errors)} runs with {number} missed packets"
        )
        parts.append(Part(f"{name}, above {lowest:g}", lowest - quantile, error))
        parts.append(Part(f"{name}, below {highest:g}", quantile - highest, error))
    return parts


def _range(printed: tuple[float, float]) -> str:
    low, high = printed
    return f"{low:g} m" if low == high else f"the middle of {low:g} to {high:g} m"


@claim(
    CLAIMS,
    "omvf-below-sun",
    "Figs. 1-2: for p < 1 the OMVF is more accurate than the filter of Sun (2009)",
)
def omvf_below_sun(results: Results) -> list[Part]:
    return more_accurate(results, "omvf", "sun")


@claim(
    CLAIMS,
    "omvf-below-sinopoli",
    "Figs. 1-2: for p < 1 the OMVF is more accurate than the filter of Sinopoli et al. (2004)",
)
def omvf_below_sinopoli(results: Results) -> list[Part]:
    return more_accurate(results, "omvf", "intermittent_kf")


@claim(
    CLAIMS,
    "omvf-below-nahi",
    "Figs. 1-2: for p < 1 the OMVF is more accurate than the filter of Nahi (1969)",
)
def omvf_below_nahi(results: Results) -> list[Part]:
    return more_accurate(results, "omvf", "nahi")


@claim(
    CLAIMS,
    "sinopoli-below-nahi",
    "Figs. 1-2: for p < 1 the filter of Sinopoli et al. (2004) is more accurate than Nahi's (1969)",
)
def sinopoli_below_nahi(results: Results) -> list[Part]:
    return more_accurate(results, "intermittent_kf", "nahi")


@claim(
    CLAIMS,
    "sun-below-nahi",
    "Figs. 1-2: for p < 1 the filter of Sun (2009) is more accurate than Nahi's (1969)",
)
def sun_below_nahi(results: Results) -> list[Part]:
    return more_accurate(results, "sun", "nahi")


@claim(
    CLAIMS,
    "omvf-and-emvf-need-no-arrivals",
    "Remarks 2 and 5: OMVF and EMVF need the arrival probability, not the arrivals",
)
def omvf_and_emvf_need_no_arrivals(results: Results) -> list[Part]:
    return [
        below(
            f"{filter_.LABEL}: number of channels besides y",
            len(set(filter_.SEES) - {"received"}),
            0.5,
        )
        for filter_ in (omvf, emvf)
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
    return [equal("errors of the runs that track", first[tracked], second[tracked], relative)]
