"""Claims on tracking in a sensor network [packet_delays Sec. 4.2, Table 2, Figs. 3-10]."""

from itertools import pairwise

import numpy as np

from repro.papers.packet_delays.claims.errors import (
    compared,
    equal,
    largest_error,
    mean_error,
    number_missed,
)
from repro.papers.packet_delays.points import TRACKING, table_2
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, most, smaller

CLAIMS: list[Claim] = []


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
