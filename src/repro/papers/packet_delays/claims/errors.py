"""Errors of the runs that the claims of [packet_delays] compare."""

from collections.abc import Callable

import numpy as np

from repro.papers.packet_delays.points import LINEAR, TRACKING, missed_packets, tracking_point
from repro.statistics.runs import Runs
from repro.studies import wsn_tracking
from repro.tables.results import Results
from repro.verdicts.claims import Part, below


def of_each_run(
    results: Results, study: str, point: str, filter_: str, quantity: Callable[[Runs], np.ndarray]
) -> np.ndarray:
    """One number of each run, (trials,)."""
    numbers = results.each(study, point, filter_, quantity)
    assert isinstance(numbers, np.ndarray)
    return numbers


def mean_error(results: Results, bound: int, arrival: str, filter_: str = "emvf") -> np.ndarray:
    """Mean position error of each run, whose mean is SAEE, (trials,), in m."""
    return of_each_run(
        results,
        TRACKING,
        tracking_point(bound, arrival),
        filter_,
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


def largest_before_and_after_miss(
    results: Results, bound: int, arrival: str, filter_: str
) -> tuple[np.ndarray, np.ndarray]:
    """Largest position errors before the only missed packet, and from its step on, in m.

    Of the runs that miss one packet, later than the first: (such runs,) each.
    """
    point = tracking_point(bound, arrival)
    error = wsn_tracking.position_error(results.runs(TRACKING, point, filter_))[:, 1:]
    missed = results.each_log(TRACKING, point, missed_packets)
    chosen = (missed.sum(axis=1) == 1) & ~missed[:, 0]
    error, after = error[chosen], np.maximum.accumulate(missed[chosen], axis=1)
    before = np.where(after, 0.0, error).max(axis=1, initial=0.0)
    return before, np.where(after, error, 0.0).max(axis=1, initial=0.0)


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


def equal(name: str, first: np.ndarray, second: np.ndarray, relative: float) -> Part:
    """Errors that must agree do so up to rounding, `relative` to the largest (or to 1)."""
    allowed = relative * max(1.0, np.abs(second).max())
    return below(name, np.abs(first - second).max(), allowed)


def compared(
    results: Results, first: tuple[int, str], second: tuple[int, str]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Errors in position of two of (N, filter) without losses, and the runs that neither loses.

    Once the target is lost, rounding grows without bound.
    """
    analysis = results.analysis(TRACKING)
    runs = [
        results.runs(TRACKING, tracking_point(bound, "1"), filter_)
        for bound, filter_ in (first, second)
    ]
    lost = [wsn_tracking.STUDY.lost(each, analysis) for each in runs]
    position = list(wsn_tracking.POSITION)
    errors = [each.error[..., position] for each in runs]
    return errors[0], errors[1], ~(lost[0] | lost[1])
