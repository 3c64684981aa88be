"""Claims on the quadrotor in closed loop (Zhang, You, Xie 2018, Sec. VI-C, Figs. 8-10)."""

import numpy as np

from repro.studies import quadrotor
from repro.tables.results import Results
from repro.verdicts.claims import Claim, claim, most, smaller

CLAIMS: list[Claim] = []
PAPERS_FILTERS = ("bkf_1", "bkf_2", "rbpf_fast")  # the RBPF by its Algorithm 4
POINTS = ("nominal", "far")
TRACKS_WITHIN = 2.0  # times the rms distance of the flight on the true state
CLOSE_WITHIN = 1.25  # times that of the flight on the EKF without losses


def distance(results: Results, point: str, filter_: str) -> np.ndarray:
    """rms distance to the reference over each flight, (flights,), in m."""
    return np.sqrt(results.each("quadrotor", point, filter_, quadrotor.squared_distance))


def over(results: Results, point: str, filter_: str) -> np.ndarray:
    """Which flights were ended before their time, (flights,)."""
    return results.each("quadrotor", point, filter_, quadrotor.lost)


def within(results: Results, factor: float, other: str):
    """Each of the paper's filters is at most `factor` times as far from the path as `other`."""
    return [
        smaller(
            f"{point}, {name}: rms distance - {factor:g} times that of {other}",
            distance(results, point, name),
            factor * distance(results, point, other),
        )
        for point in POINTS
        for name in PAPERS_FILTERS
    ]


@claim(CLAIMS, "B-C13 tracks", "Figs. 8-9: BKF-I, BKF-II and RBPF fly the path")
def filters_track(results):
    flown = [
        most(f"{point}, {name}: flies to the end", ~over(results, point, name))
        for point in POINTS
        for name in PAPERS_FILTERS
    ]
    return [*flown, *within(results, TRACKS_WITHIN, "true_state")]


@claim(CLAIMS, "B-C13 close", "Figs. 8-9: they come close to the EKF without losses")
def filters_come_close(results):
    return within(results, CLOSE_WITHIN, "ekf_no_loss")


@claim(CLAIMS, "B-C14", "Text: the EKF that ignores the losses cannot follow the path")
def ignoring_losses_fails(results):
    return [
        smaller(
            f"{point}: {TRACKS_WITHIN:g} times the rms distance without losses - its own",
            TRACKS_WITHIN * distance(results, point, "ekf_no_loss"),
            distance(results, point, "ekf"),
        )
        for point in POINTS
    ]


def diverges(results: Results, point: str):
    """Most flights are ended, because the quadrotor tumbles or leaves."""
    return [most(f"{point}: flights ended", over(results, point, "ekf"))]


@claim(CLAIMS, "B-C15 nominal", "Fig. 10: its tracking error diverges (the path of [26])")
def diverges_near(results):
    return diverges(results, "nominal")


@claim(CLAIMS, "B-C15 far", "Fig. 10: its tracking error diverges (path 100 times as large)")
def diverges_far(results):
    return diverges(results, "far")
