"""Claims of Zhang, You, Xie 2018 on the linear system (Sections V-A, VI-A; Figures 1, 2)."""

from itertools import pairwise

import numpy as np
import pandas as pd

from repro.papers.unknown_losses import operation_counts
from repro.statistics import metrics
from repro.statistics.shards import Columns
from repro.studies import linear_losses
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, smaller
from repro.verdicts.rmse import negative, smaller_rmse

CLAIMS: list[Claim] = []
LINEAR_P = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
PARTICLES = (2, 5, 10, 20, 50, 100, 200, 500, 1000)
PAPERS_FILTERS = ("bkf_1", "bkf_2", "rbpf")
TIMES = "params/measured/unknown_losses_iteration_times.csv"


def linear(results: Results, point: str, filter_: str) -> Columns:
    """Squared error of every run and step."""
    return results.each("linear_losses", point, filter_, linear_losses.squared_error)


@claim(CLAIMS, "Table I O(N)", "Table I: the RBPF needs O(N) matrix products an iteration")
def products_are_linear_in_particles(results):
    def products(particles):
        rows = operation_counts.table_1(n=6, m=2, particles=particles)
        return next(
            row["value"]
            for row in rows
            if (row["filter"], row["component"]) == ("rbpf", "products")
        )

    excess = abs(products(200) / products(20) - 10)
    return [below("|products at N=200 over those at N=20 - 10|", excess, 1e-9)]


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
            *(linear(results, f"particles={n}-loss={p}", "rbpf") for n in (2, 20, 1000)),
        )
        for p in (0.3, 0.5)
    ]


@claim(CLAIMS, "B-C3 p", "Fig. 2: how many particles are needed depends on p")
def needed_particles_depend_on_p(results):
    numbers = [
        metrics.roots_over_steps(linear(results, f"particles={n}-loss={p}", "rbpf"))
        for p in (0.3, 0.5)
        for n in (5, 1000)
    ]

    def difference(few, many, few_other, many_other):
        return few / many - few_other / many_other

    # Either sign would do: how far 0 lies from the difference.
    return [
        Part(
            "relative excess of N=5 over N=1000, p=0.3 against p=0.5: minus its size",
            -abs(difference(*(number.value for number in numbers))),
            float(metrics.jackknife_error(difference(*(n.left_out for n in numbers)))),
        )
    ]


def iteration_time(filter_: str, particles: int, p: float) -> np.ndarray:
    """Measured microseconds of an iteration of one trial, and their standard error."""
    times = pd.read_csv(TIMES).set_index(["filter", "particles", "loss"])
    return times.loc[(filter_, particles, p), ["microseconds", "error"]].to_numpy(dtype=float)


def faster(first: str, second: str, particles: int) -> list[Part]:
    """An iteration of `first` takes less time than one of `second`."""
    parts = []
    for p in (0.3, 0.5):
        (own, own_error), (other, other_error) = (
            iteration_time(name, particles, p) for name in (first, second)
        )
        error = float(np.hypot(own_error, other_error))
        parts.append(Part(f"p={p}, N={particles}: {first} - {second} in us", own - other, error))
    return parts


@claim(CLAIMS, "B-C4 proportional", "Fig. 2: the time of an RBPF iteration is proportional to N")
def time_is_proportional(results):
    return [
        below(
            f"p={p}: |log10 of time(1000) / time(100) - 1|",
            abs(
                np.log10(iteration_time("rbpf", 1000, p)[0] / iteration_time("rbpf", 100, p)[0]) - 1
            ),
            0.15,
        )
        for p in (0.3, 0.5)
    ]


@claim(CLAIMS, "B-C4 few", "Fig. 2: with few particles the Fast RBPF is slower (N = 2)")
def fast_is_slower_with_few(results):
    return faster("rbpf", "rbpf_fast", 2)


@claim(CLAIMS, "B-C4 many", "Fig. 2: with many particles the Fast RBPF is faster (N = 1000)")
def fast_is_faster_with_many(results):
    return faster("rbpf_fast", "rbpf", 1000)


@claim(CLAIMS, "B-C4 triples", "Sec. IV-C: with many particles most triples are duplicates")
def most_triples_are_duplicates(results):
    parts = []
    for p in (0.3, 0.5):
        point = f"particles=1000-loss={p}"
        distinct = results.each(
            "linear_losses", point, "rbpf_fast", lambda runs: runs.recorded["triples"].mean(axis=1)
        )
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
        before, after = (
            results.each(
                "linear_losses",
                f"loss={p}",
                "iekf",
                lambda runs, steps=steps: linear_losses.squared_error(runs)[:, steps].mean(axis=1),
            )
            for steps in (slice(100, 150), slice(150, None))
        )
        parts.append(smaller(f"p={p}: last quarter - 1.25 third quarter", after, 1.25 * before))
    return parts
