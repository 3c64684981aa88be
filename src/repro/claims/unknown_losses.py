"""Claims of Zhang, You, Xie 2018, Sections V and VI-A, VI-B (Figures 1-5 and their text)."""

from itertools import pairwise

import numpy as np
import pandas as pd

from repro import metrics
from repro.claims import Claim, Part, below, claim, most, smaller
from repro.results import Results
from repro.studies import linear_losses, radar

CLAIMS: list[Claim] = []
LINEAR_P = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
RADAR_P = (0.1, 0.3, 0.5, 0.7, 0.8, 0.9)
LARGE_P = (0.7, 0.8, 0.9)
PARTICLES = (2, 5, 10, 20, 50, 100, 200, 500, 1000)
PAPERS_FILTERS = ("bkf_1", "bkf_2", "rbpf")
TIMES = "params/measured/unknown_losses_iteration_times.csv"


def linear(results: Results, point: str, filter_: str) -> np.ndarray:
    """Squared error of every run and step, (trials, steps)."""
    return linear_losses.squared_error(results.runs("linear_losses", point, filter_))


def tracking(results: Results, point: str, filter_: str) -> np.ndarray:
    """Squared position error of every run and step, (trials, steps)."""
    return radar.squared_error(results.runs("radar", point, filter_))


def rmse(over_steps, *squared: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sum or mean over the steps of RMSE_k, of each filter and with one trial left out each."""
    values = [over_steps(np.sqrt(s.mean(axis=0))) for s in squared]
    left_out = [over_steps(metrics.leave_one_out(s, np.sqrt), axis=1) for s in squared]
    return np.array(values), np.array(left_out)


def negative(what: str, combination, over_steps, *squared: np.ndarray) -> Part:
    """A combination of several filters' RMSE is negative; its error is that of paired trials."""
    values, left_out = rmse(over_steps, *squared)
    error = metrics.jackknife_error(combination(*left_out))
    return Part(what, float(combination(*values)), float(error))


def smaller_rmse(what: str, first: np.ndarray, second: np.ndarray, over_steps=np.sum) -> Part:
    """The first filter's RMSE, summed or averaged over the steps, is the smaller."""
    return negative(what, lambda a, b: a - b, over_steps, first, second)


@claim(CLAIMS, "B-C1 IKF", "Fig. 1: the IKF has a smaller RMSE than BKF-I, BKF-II and RBPF")
def ikf_is_best(results):
    return [
        smaller_rmse(
            f"p={p}: iekf - {name}",
            linear(results, f"loss={p}", "iekf"),
            linear(results, f"loss={p}", name),
        )
        for p in LINEAR_P
        for name in PAPERS_FILTERS
    ]


@claim(CLAIMS, "B-C1 KF", "Fig. 1: BKF-I, BKF-II and RBPF have a smaller RMSE than the KF")
def better_than_ignoring_losses(results):
    return [
        smaller_rmse(
            f"p={p}: {name} - ekf",
            linear(results, f"loss={p}", name),
            linear(results, f"loss={p}", "ekf"),
        )
        for p in LINEAR_P
        for name in PAPERS_FILTERS
    ]


@claim(CLAIMS, "B-C1 close", "Fig. 1: the three are close to the IKF: nearer to it than to the KF")
def close_to_ikf(results):
    return [
        negative(
            f"p={p}: distance of {name} to iekf - to ekf",
            lambda own, best, worst: 2 * own - best - worst,
            np.sum,
            *(linear(results, f"loss={p}", f) for f in (name, "iekf", "ekf")),
        )
        for p in LINEAR_P
        for name in PAPERS_FILTERS
    ]


def gain_grows(results: Results, gain) -> list[Part]:
    return [
        negative(
            f"{name}: gain at p={low} - p={high}",
            lambda kf_low, own_low, kf_high, own_high: (
                gain(kf_low, own_low) - gain(kf_high, own_high)
            ),
            np.sum,
            *(linear(results, f"loss={p}", f) for p in (low, high) for f in ("ekf", name)),
        )
        for name in PAPERS_FILTERS
        for low, high in pairwise(LINEAR_P)
    ]


@claim(CLAIMS, "B-C2 gap", "Fig. 1: the gain over the KF, as a difference, grows with p")
def difference_grows(results):
    return gain_grows(results, lambda kf, own: kf - own)


@claim(CLAIMS, "B-C2 ratio", "Fig. 1: the gain over the KF, as a ratio, grows with p")
def ratio_grows(results):
    return gain_grows(results, lambda kf, own: kf / own)


@claim(CLAIMS, "B-C3 falls", "Fig. 2: more particles, a smaller RMSE, up to N = 20")
def more_particles_are_better(results):
    return [
        smaller_rmse(
            f"p={p}: N={more} - N={less}",
            linear(results, f"particles={more}-loss={p}", "rbpf"),
            linear(results, f"particles={less}-loss={p}", "rbpf"),
        )
        for p in (0.3, 0.5)
        for less, more in pairwise(n for n in PARTICLES if n <= 20)
    ]


@claim(CLAIMS, "B-C3 slows", "Fig. 2: from N = 20 to 1000 the RMSE falls less than from 2 to 20")
def gain_slows(results):
    return [
        negative(
            f"p={p}: fall from 20 to 1000 - from 2 to 20",
            lambda few, some, many: (some - many) - (few - some),
            np.sum,
            *(linear(results, f"particles={n}-loss={p}", "rbpf") for n in (2, 20, 1000)),
        )
        for p in (0.3, 0.5)
    ]


@claim(CLAIMS, "B-C3 p", "Fig. 2: how many particles are needed depends on p")
def needed_particles_depend_on_p(results):
    values, left_out = rmse(
        np.sum,
        *(
            linear(results, f"particles={n}-loss={p}", "rbpf")
            for p in (0.3, 0.5)
            for n in (5, 1000)
        ),
    )

    def difference(few, many, few_other, many_other):
        return few / many - few_other / many_other

    # Either sign would do: how far 0 lies from the difference.
    return [
        Part(
            "relative excess of N=5 over N=1000, p=0.3 against p=0.5: minus its size",
            -abs(float(difference(*values))),
            float(metrics.jackknife_error(difference(*left_out))),
        )
    ]


def iteration_time(filter_: str, particles: int, p: float) -> float:
    """Measured microseconds of an iteration of one trial."""
    times = pd.read_csv(TIMES).set_index(["filter", "particles", "loss"])["microseconds"]
    return float(times.loc[filter_, particles, p])


@claim(CLAIMS, "B-C4 proportional", "Fig. 2: the time of an RBPF iteration is proportional to N")
def time_is_proportional(results):
    return [
        below(
            f"p={p}: |log10 of time(1000) / time(100) - 1|",
            abs(np.log10(iteration_time("rbpf", 1000, p) / iteration_time("rbpf", 100, p)) - 1),
            0.15,
        )
        for p in (0.3, 0.5)
    ]


@claim(CLAIMS, "B-C4 few", "Fig. 2: with few particles the Fast RBPF is slower (N = 2)")
def fast_is_slower_with_few(results):
    return [
        below(f"p={p}: us", iteration_time("rbpf", 2, p), iteration_time("rbpf_fast", 2, p))
        for p in (0.3, 0.5)
    ]


@claim(CLAIMS, "B-C4 many", "Fig. 2: with many particles the Fast RBPF is faster (N = 1000)")
def fast_is_faster_with_many(results):
    return [
        below(f"p={p}: us", iteration_time("rbpf_fast", 1000, p), iteration_time("rbpf", 1000, p))
        for p in (0.3, 0.5)
    ]


@claim(CLAIMS, "B-C4 triples", "Sec. IV-C: with many particles most triples are duplicates")
def most_triples_are_duplicates(results):
    parts = []
    for p in (0.3, 0.5):
        runs = results.runs("linear_losses", f"particles=1000-loss={p}", "rbpf_fast")
        distinct = runs.recorded["triples"].mean(axis=1)
        parts.append(smaller(f"p={p}: distinct of 1000 - 500", distinct, np.full(1, 500.0)))
    return parts


@claim(CLAIMS, "B-C5 IKF", "Sec. V-A: with more particles the RBPF comes arbitrarily near the IKF")
def rbpf_approaches_ikf(results):
    runs = {f: linear(results, "short-loss=0.3", f) for f in ("iekf", "exact")}
    return [smaller_rmse("p=0.3: limit of the RBPF (exact) - iekf", runs["exact"], runs["iekf"])]


@claim(CLAIMS, "B-C5 limit", "Introduction: the RBPF approximates the estimate without gamma")
def rbpf_approaches_exact(results):
    runs = {
        name: results.runs("linear_losses", "short-loss=0.3", name).error
        for name in ("exact", "rbpf", "rbpf_fast", "bkf_2")
    }
    distance = {
        name: (((error - runs["exact"]) ** 2).sum(axis=-1)).mean(axis=1)
        for name, error in runs.items()
    }
    many = distance["rbpf_fast"]  # 1000 particles at this point
    return [
        smaller(
            "squared distance to exact: N=1000 - a tenth of N=20's", many, distance["rbpf"] / 10
        ),
        smaller("squared distance to exact: N=1000 - bkf_2", many, distance["bkf_2"]),
    ]


@claim(CLAIMS, "B-C6", "Sec. VI-A: the IKF is mean-square stable for every p < 1")
def ikf_is_stable(results):
    parts = []
    for p in LINEAR_P:
        squared = linear(results, f"loss={p}", "iekf")
        before, after = squared[:, 100:150].mean(axis=1), squared[:, 150:].mean(axis=1)
        parts.append(smaller(f"p={p}: last quarter - 1.25 third quarter", after, 1.25 * before))
    return parts


def points(results: Results, losses) -> list[tuple[str, str]]:
    """Points of the radar at these p, the one with most runs at each, and its RBPF."""
    known = results.catalogue["radar"]
    return [
        (f"pooled-loss={p}", "rbpf_fast") if f"pooled-loss={p}" in known else (f"loss={p}", "rbpf")
        for p in losses
    ]


def on_average(results: Results, first: str, second: str) -> list[Part]:
    """`first` has the smaller RMSE, averaged over the steps and over p; the runs share their noise."""
    squared = [tracking(results, f"loss={p}", name) for p in RADAR_P for name in (first, second)]

    def difference(*values):
        return sum(values[::2]) / len(RADAR_P) - sum(values[1::2]) / len(RADAR_P)

    return [negative(f"mean over p: {first} - {second}", difference, np.mean, *squared)]


def tracked_better(results: Results, first: str, second: str, losses) -> list[Part]:
    """`first` has the smaller mean over the steps of RMSE_k."""
    parts = []
    for point, rbpf in points(results, losses):
        names = [rbpf if name == "rbpf" else name for name in (first, second)]
        runs = [tracking(results, point, name) for name in names]
        parts.append(smaller_rmse(f"{point}: {first} - {second}", *runs, np.mean))
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
            np.mean,
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
    return radar.lost(results.runs("radar", point, filter_))


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
