"""Claims of Zhang, You, Xie 2018 on radar tracking (Sections V-A, VI-B; Figures 3-5)."""

from itertools import pairwise

import numpy as np

from repro.statistics.shards import Columns
from repro.studies import radar
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, most, smaller
from repro.verdicts.rmse import negative, smaller_rmse

CLAIMS: list[Claim] = []
RADAR_P = (0.1, 0.3, 0.5, 0.7, 0.8, 0.9)
LARGE_P = (0.7, 0.8, 0.9)
PAPERS_FILTERS = ("bkf_1", "bkf_2", "rbpf")


def tracking(results: Results, point: str, filter_: str) -> Columns:
    """Squared position error of every run and step."""
    return results.each("radar", point, filter_, radar.squared_error)


def points(results: Results, losses) -> list[tuple[str, str]]:
    """Points of the radar at these p, the one with most runs at each, and its RBPF."""
    known = results.catalogue["radar"]
    return [
        (f"pooled-loss={p}", "rbpf_fast") if f"pooled-loss={p}" in known else (f"loss={p}", "rbpf")
        for p in losses
    ]


def on_average(results: Results, first: str, second: str) -> list[Part]:
    """`first` has the smaller RMSE, averaged over the steps and over p."""
    squared = [tracking(results, f"loss={p}", name) for p in RADAR_P for name in (first, second)]

    def difference(*values):
        return sum(values[::2]) / len(RADAR_P) - sum(values[1::2]) / len(RADAR_P)

    return [negative(f"mean over p: {first} - {second}", difference, *squared, average=True)]


def tracked_better(results: Results, first: str, second: str, losses) -> list[Part]:
    """`first` has the smaller mean over the steps of RMSE_k."""
    parts = []
    for point, rbpf in points(results, losses):
        names = [rbpf if name == "rbpf" else name for name in (first, second)]
        runs = [tracking(results, point, name) for name in names]
        parts.append(smaller_rmse(f"{point}: {first} - {second}", *runs, average=True))
    return parts


@claim(CLAIMS, "B-C7", "Figs. 3-4: the RBPF generally has a smaller RMSE than BKF-I and BKF-II")
def rbpf_beats_bkf(results):
    return on_average(results, "rbpf", "bkf_1") + on_average(results, "rbpf", "bkf_2")


@claim(CLAIMS, "B-C7 every p", "Figs. 3-4: it has at every p")
def rbpf_beats_bkf_at_every_p(results):
    return [
        part
        for name in ("bkf_1", "bkf_2")
        for part in tracked_better(results, "rbpf", name, RADAR_P)
    ]


@claim(CLAIMS, "B-C8", "Figs. 3-4: BKF-I appears to have a smaller RMSE than BKF-II")
def bkf_1_beats_bkf_2(results):
    return on_average(results, "bkf_1", "bkf_2")


@claim(CLAIMS, "B-C8 every p", "Figs. 3-4: it has at every p")
def bkf_1_beats_bkf_2_at_every_p(results):
    return tracked_better(results, "bkf_1", "bkf_2", RADAR_P)


@claim(CLAIMS, "B-C9", "Figs. 3-4: the RMSE of every filter grows with p")
def rmse_grows_with_p(results):
    return [
        smaller_rmse(
            f"{name}: p={low} - p={high}",
            tracking(results, f"loss={low}", name),
            tracking(results, f"loss={high}", name),
            average=True,
        )
        for name in ("iekf", *PAPERS_FILTERS)
        for low, high in pairwise(RADAR_P)
    ]


@claim(CLAIMS, "B-C10 RBPF", "Figs. 3-4: for large p the RBPF has a smaller RMSE than the IEKF")
def rbpf_beats_iekf(results):
    return tracked_better(results, "rbpf", "iekf", LARGE_P)


@claim(CLAIMS, "B-C10 BKF", "Sec. V-A: the IEKF usually has a smaller RMSE than BKF-I and BKF-II")
def iekf_beats_bkf(results):
    return on_average(results, "iekf", "bkf_1") + on_average(results, "iekf", "bkf_2")


def lost(results: Results, point: str, filter_: str) -> np.ndarray:
    """Which runs end more than 100 m from the target, (trials,)."""
    return results.each("radar", point, filter_, radar.lost)


@claim(CLAIMS, "B-C11 well", "Fig. 5a, b: at p = 0.5 and 0.7 the filters follow the target")
def tracks_are_followed(results):
    return [
        most(f"p={p}, {name}: ends within 100 m", ~lost(results, f"loss={p}", name))
        for p in (0.5, 0.7)
        for name in PAPERS_FILTERS
    ]


@claim(CLAIMS, "B-C11 lower p", "Fig. 5a, b: they follow it better at the lower p")
def lower_p_is_followed_better(results):
    return [
        smaller(
            f"{name}: share of lost runs at p=0.5 - p=0.7",
            lost(results, "loss=0.5", name).astype(float),
            lost(results, "loss=0.7", name).astype(float),
        )
        for name in PAPERS_FILTERS
    ]


@claim(CLAIMS, "B-C12", "Fig. 5c: at p = 0.9 from a poor start every filter fails, the IEKF too")
def poor_start_fails(results):
    parts = []
    for name in ("iekf", *PAPERS_FILTERS):
        poor, good = (lost(results, point, name) for point in ("poor-loss=0.9", "loss=0.9"))
        parts.append(most(f"{name}: ends more than 100 m off", poor))
        parts.append(
            smaller(
                f"{name}: share of lost runs, good start - poor start",
                good.astype(float),
                poor.astype(float),
            )
        )
    return parts
