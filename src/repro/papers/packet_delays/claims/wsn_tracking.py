"""Claims on single runs in a sensor network [packet_delays Sec. 4.2, Figs. 3-10]."""

import numpy as np

from repro.papers.packet_delays.claims.errors import (
    compared,
    equal,
    largest_before_and_after_miss,
    largest_error,
    number_missed,
)
from repro.papers.packet_delays.points import TRACKING
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, most

CLAIMS: list[Claim] = []


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
    name = f"errors of the {tracked.sum()} of {len(tracked)} runs that track"
    return [equal(name, first[tracked], second[tracked], relative)]


@claim(
    CLAIMS,
    "ekf-error-jumps-at-missed-packet",
    "Fig. 6: at p = 0.98 the error of the EKF becomes much higher once a packet is missed",
)
def ekf_error_jumps_at_missed_packet(results: Results) -> list[Part]:
    factor = results.analysis(TRACKING).much_higher
    parts = []
    for bound in (1, 2):
        before, after = largest_before_and_after_miss(results, bound, "0.98", "ekf")
        name = f"N={bound}: largest error after the only missed packet > {factor:g} times before"
        parts.append(most(name, after > factor * before))
    return parts


@claim(
    CLAIMS,
    "emvf-far-below-ekf-after-missed-packet",
    "Figs. 5-6: at p = 0.98 the error of the EKF after a missed packet is far above the EMVF's",
)
def emvf_far_below_ekf_after_missed_packet(results: Results) -> list[Part]:
    missed = number_missed(results, 1, "0.98") > 0
    factor = results.analysis(TRACKING).much_higher
    return [
        most(
            f"N={bound}: largest error of the EKF > {factor:g} times the EMVF's, "
            "runs with a missed packet",
            (
                factor * largest_error(results, bound, "0.98", "emvf")
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
    analysis, comparable = results.analysis(TRACKING), _as_in_figure_10(results)
    return [
        part
        for bound, printed in analysis.figure_10_largest_errors.items()
        for part in _typical(
            f"N={bound}: {_range(printed)}",
            float(np.mean(printed)),
            largest_error(results, bound, "0.9", "emvf")[comparable],
            analysis.typical_quantiles,
        )
    ]


@claim(
    CLAIMS,
    "figure-10-is-typical-in-one-run",
    "Fig. 10: its two largest errors, of one run, have a ratio that is typical of such runs",
)
def figure_10_is_typical_in_one_run(results: Results) -> list[Part]:
    analysis, comparable = results.analysis(TRACKING), _as_in_figure_10(results)
    (first, of_first), (second, of_second) = sorted(analysis.figure_10_largest_errors.items())
    ratio = float(np.mean(of_first) / np.mean(of_second))
    ours = [largest_error(results, bound, "0.9", "emvf")[comparable] for bound in (first, second)]
    name = f"largest error with N={first} over that with N={second}: {ratio:.2f}"
    return _typical(name, ratio, ours[0] / ours[1], analysis.typical_quantiles)


def _as_in_figure_10(results: Results) -> np.ndarray:
    """Which runs miss as many packets as the printed one, (trials,); N = 1 and N = 2 agree."""
    missed = results.analysis(TRACKING).figure_10_missed_packets
    return number_missed(results, 1, "0.9") == missed


def _typical(
    name: str, printed: float, comparable: np.ndarray, quantiles: tuple[float, float]
) -> list[Part]:
    """A printed number is not among the extremes of the comparable runs, (runs,).

    The standard error of its quantile is that of Agresti and Coull (1998), which is not zero at the
    quantiles 0 and 1.
    """
    runs, (lowest, highest) = len(comparable), quantiles
    below = np.count_nonzero(comparable < printed)
    quantile = below / runs if runs else np.nan
    near = (below + 2) / (runs + 4)
    error = float(np.sqrt(near * (1 - near) / (runs + 4)))
    found = f"{name} is quantile {quantile:.3f} of {runs} runs with as many missed packets"
    return [
        Part(f"{found}, above {lowest:g}", lowest - quantile, error),
        Part(f"{found}, below {highest:g}", quantile - highest, error),
    ]


def _range(printed: tuple[float, float]) -> str:
    low, high = printed
    return f"{low:g} m" if low == high else f"the middle of {low:g} to {high:g} m"
