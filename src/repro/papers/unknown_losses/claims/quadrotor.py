"""Claims on the quadrotor in closed loop [unknown_losses Sec. VI-C, Figs. 8-10]."""

from collections.abc import Iterator

import numpy as np

from repro.kernels import arrays
from repro.papers.unknown_losses.points import plain_points, proposed_filters
from repro.statistics import metrics
from repro.studies import quadrotor
from repro.studies.quadrotor import Analysis
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, most, smaller
from repro.verdicts.equivalence import equivalent

CLAIMS: list[Claim] = []
STUDY = "quadrotor"


def thresholds(results: Results) -> Analysis:
    """Of the claims below."""
    return results.analysis(STUDY)


def distance(results: Results, point: str, filter_: str) -> np.ndarray:
    """rms distance to the reference over each flight, (flights,), in m."""
    return np.sqrt(results.each(STUDY, point, filter_, quadrotor.squared_distance))


def ended(results: Results, point: str, filter_: str) -> np.ndarray:
    """Which flights tumbled, or left, before the last step, (flights,)."""
    return results.each(STUDY, point, filter_, quadrotor.ended)


def flights(results: Results) -> Iterator[tuple[str, str]]:
    """Point and name of each of the paper's filters."""
    for point in plain_points(results.catalogue, STUDY):
        for name in proposed_filters(results.catalogue, STUDY, point):
            yield point, name


def within(results: Results, factor: float, other: str) -> list[Part]:
    """Each of the paper's filters is at most `factor` times as far from the path as `other`."""
    return [
        smaller(
            f"{point}, {name}: rms distance - {factor:g} times that of {other}",
            distance(results, point, name),
            factor * distance(results, point, other),
        )
        for point, name in flights(results)
    ]


@claim(CLAIMS, "filters-fly-the-path", "Figs. 8-9: BKF-I, BKF-II and RBPF fly the path")
def filters_track(results: Results) -> list[Part]:
    flown = [
        most(f"{point}, {name}: flies to the end", ~ended(results, point, name))
        for point, name in flights(results)
    ]
    return [*flown, *within(results, thresholds(results).tracks_within, "true_state")]


@claim(
    CLAIMS,
    "filters-close-to-ekf-without-losses",
    "Figs. 8-9: the flights on BKF-I, BKF-II and RBPF come close to that without losses",
)
def filters_come_close(results: Results) -> list[Part]:
    margin, parts = arrays.log(thresholds(results).close_within), []
    for point, name in flights(results):
        ours, theirs = (distance(results, point, f) for f in (name, "ekf_no_loss"))
        ratio = ours.mean() / theirs.mean()
        # The error of the logarithm of a ratio of paired means, to first order.
        error = metrics.mean_error(ours / ours.mean() - theirs / theirs.mean())
        what = f"{point}: log of rms distance of {name} over that of ekf_no_loss"
        parts += equivalent(what, arrays.log(ratio), float(error), margin)
    return parts


@claim(
    CLAIMS,
    "ignoring-losses-misses-path",
    "Sec. VI-C: on the EKF that ignores the losses the quadrotor cannot follow the path",
)
def ignoring_losses_fails(results: Results) -> list[Part]:
    factor = thresholds(results).tracks_within
    return [
        smaller(
            f"{point}: {factor:g} times the rms distance without losses - that of ekf",
            factor * distance(results, point, "ekf_no_loss"),
            distance(results, point, "ekf"),
        )
        for point in plain_points(results.catalogue, STUDY)
    ]


def diverges(results: Results, point: str) -> list[Part]:
    """Most flights are ended, because the quadrotor tumbles or leaves."""
    return [most(f"{point}: flights ended", ended(results, point, "ekf"))]


@claim(
    CLAIMS,
    "ignoring-losses-diverges-nominal",
    "Fig. 10: if losses are ignored the tracking error diverges, on the path of [26]",
)
def diverges_near(results: Results) -> list[Part]:
    return diverges(results, "nominal")


@claim(
    CLAIMS,
    "ignoring-losses-diverges-far",
    "Fig. 10: if losses are ignored the tracking error diverges, on the far path",
)
def diverges_far(results: Results) -> list[Part]:
    return diverges(results, "far")
