"""Claims on radar tracking [unknown_losses Sec. V-A, VI-B, Figs. 3-5]."""

from collections.abc import Iterable
from itertools import pairwise

import numpy as np

from repro.papers.unknown_losses.points import (
    PROPOSED,
    most_runs,
    proposed_filters,
    rbpf_of,
    swept,
)
from repro.statistics.metrics import Jackknife
from repro.studies import radar
from repro.studies.radar import Analysis
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, most, smaller
from repro.verdicts.rmse import negative, smaller_rmse

CLAIMS: list[Claim] = []
STUDY = "radar"
TRACKS = {0.5: "loss=0.5", 0.7: "loss=0.7"}  # of Figs. 5a and 5b
POOR_START, GOOD_START = "poor-loss=0.9", "loss=0.9"  # of Fig. 5c, and what it is compared with


def thresholds(results: Results) -> Analysis:
    """Of the claims below."""
    return results.analysis(STUDY)


def tracking(results: Results, point: str, filter_: str) -> Jackknife:
    """The RMSE of the position, mean over the steps, in m; `rbpf` by either algorithm."""
    if filter_ == "rbpf":
        filter_ = rbpf_of(results.catalogue, STUDY, point)
    return results.rmse(STUDY, point, filter_, radar.squared_error, average=True)


def proposed(results: Results) -> tuple[str, ...]:
    """The paper's filters, as they run over the loss probability."""
    return proposed_filters(results.catalogue, STUDY, GOOD_START)


def on_average(results: Results, first: str, second: str, points: Iterable[str]) -> list[Part]:
    """`first` has the smaller RMSE, averaged over the steps and over points, one of each p."""
    numbers = [tracking(results, point, name) for point in points for name in (first, second)]

    def difference(*values):
        return sum(values[::2]) / len(values[::2]) - sum(values[1::2]) / len(values[1::2])

    return [negative(f"mean over p: {first} - {second}", difference, *numbers)]


def tracked_better(results: Results, first: str, second: str, points: Iterable[str]) -> list[Part]:
    """`first` has the smaller mean over the steps of RMSE_k."""
    return [
        smaller_rmse(
            f"{point}: {first} - {second}",
            tracking(results, point, first),
            tracking(results, point, second),
        )
        for point in points
    ]


@claim(
    CLAIMS,
    "rbpf-below-bkf-on-average",
    "Figs. 3-4: averaged over p, the RBPF has a smaller RMSE than BKF-I and BKF-II",
)
def rbpf_beats_bkf(results: Results) -> list[Part]:
    points = most_runs(results.catalogue, STUDY).values()
    return [
        part for name in ("bkf_1", "bkf_2") for part in on_average(results, "rbpf", name, points)
    ]


@claim(
    CLAIMS,
    "rbpf-below-bkf-at-every-p",
    "Figs. 3-4: at every p the RBPF has a smaller RMSE than BKF-I and BKF-II",
)
def rbpf_beats_bkf_at_every_p(results: Results) -> list[Part]:
    points = most_runs(results.catalogue, STUDY).values()
    return [
        part
        for name in ("bkf_1", "bkf_2")
        for part in tracked_better(results, "rbpf", name, points)
    ]


@claim(
    CLAIMS,
    "bkf-1-below-bkf-2-on-average",
    "Figs. 3-4: averaged over p, BKF-I has a smaller RMSE than BKF-II",
)
def bkf_1_beats_bkf_2(results: Results) -> list[Part]:
    return on_average(results, "bkf_1", "bkf_2", most_runs(results.catalogue, STUDY).values())


@claim(
    CLAIMS,
    "bkf-1-below-bkf-2-at-every-p",
    "Figs. 3-4: at every p BKF-I has a smaller RMSE than BKF-II, in the paper's number of runs",
)
def bkf_1_beats_bkf_2_at_every_p(results: Results) -> list[Part]:
    return tracked_better(results, "bkf_1", "bkf_2", swept(results.catalogue, STUDY).values())


@claim(CLAIMS, "rmse-grows-with-p", "Figs. 3-4: the RMSE of every filter grows with p")
def rmse_grows_with_p(results: Results) -> list[Part]:
    points = most_runs(results.catalogue, STUDY)
    return [
        smaller_rmse(
            f"{name}: p={low} - p={high}",
            tracking(results, points[low], name),
            tracking(results, points[high], name),
        )
        for name in ("iekf", *PROPOSED)
        for low, high in pairwise(points)
    ]


@claim(
    CLAIMS,
    "rbpf-below-iekf-at-large-p",
    "Figs. 3-4: at large p the RBPF has a smaller RMSE than the IEKF",
)
def rbpf_beats_iekf(results: Results) -> list[Part]:
    points, from_ = most_runs(results.catalogue, STUDY), thresholds(results).large_loss
    return tracked_better(results, "rbpf", "iekf", [points[p] for p in points if p >= from_])


@claim(
    CLAIMS,
    "iekf-below-bkf-on-average",
    "Sec. V-A: averaged over p, the IEKF has a smaller RMSE than both BKF, in the paper's runs",
)
def iekf_beats_bkf(results: Results) -> list[Part]:
    points = swept(results.catalogue, STUDY).values()
    return [
        part for name in ("bkf_1", "bkf_2") for part in on_average(results, "iekf", name, points)
    ]


def lost(results: Results, point: str, filter_: str) -> np.ndarray:
    """Which runs end without the target, (trials,)."""
    analysis = thresholds(results)
    return results.each(STUDY, point, filter_, lambda runs: radar.STUDY.lost(runs, analysis))


@claim(
    CLAIMS,
    "filters-follow-target",
    "Figs. 5a, b: at p = 0.5 and 0.7 BKF-I, BKF-II and RBPF follow the target",
)
def tracks_are_followed(results: Results) -> list[Part]:
    bound = thresholds(results).lost_above
    return [
        most(f"p={p}, {name}: ends within {bound:g} m", ~lost(results, point, name))
        for p, point in TRACKS.items()
        for name in proposed(results)
    ]


@claim(
    CLAIMS,
    "lower-p-followed-better",
    "Figs. 5a, b: BKF-I, BKF-II and RBPF follow the target better at the lower p",
)
def lower_p_is_followed_better(results: Results) -> list[Part]:
    low, high = sorted(TRACKS)
    return [
        smaller(
            f"{name}: share of lost runs at p={low} - p={high}",
            lost(results, TRACKS[low], name).astype(float),
            lost(results, TRACKS[high], name).astype(float),
        )
        for name in proposed(results)
    ]


@claim(
    CLAIMS,
    "poor-start-loses-target",
    "Fig. 5c: at p = 0.9 every filter, the IEKF too, loses the target from a poor start",
)
def poor_start_fails(results: Results) -> list[Part]:
    parts, bound = [], thresholds(results).lost_above
    for name in ("iekf", *proposed(results)):
        poor, good = (lost(results, point, name) for point in (POOR_START, GOOD_START))
        parts.append(most(f"{name}: ends more than {bound:g} m off", poor))
        parts.append(
            smaller(
                f"{name}: share of lost runs, good start - poor start",
                good.astype(float),
                poor.astype(float),
            )
        )
    return parts
