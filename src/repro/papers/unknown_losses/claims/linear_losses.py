"""Claims on the linear system [unknown_losses Sec. V, VI-A, Figs. 1, 2, Table I]."""

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
import pandas as pd

from repro.papers.unknown_losses import operation_counts
from repro.papers.unknown_losses.points import particle_sweeps, proposed_filters, swept
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.statistics.shards import Columns
from repro.studies import linear_losses, radar
from repro.studies.linear_losses import Analysis
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, smaller
from repro.verdicts.rmse import negative, smaller_rmse

CLAIMS: list[Claim] = []
STUDY = "linear_losses"
TIMES = "params/measured/unknown_losses_iteration_times.csv"


def thresholds(results: Results) -> Analysis:
    """Of the claims below."""
    return results.analysis(STUDY)


def linear(results: Results, point: str, filter_: str) -> Columns:
    """Squared error of every run and step."""
    return results.each(STUDY, point, filter_, linear_losses.squared_error)


def filters_over_p(results: Results) -> Iterator[tuple[float, str, str]]:
    """Loss probability, point and name of each of the paper's filters at each p of Fig. 1."""
    for p, point in swept(results.catalogue, STUDY).items():
        for name in proposed_filters(results.catalogue, STUDY, point):
            yield p, point, name


@claim(
    CLAIMS,
    "rbpf-products-proportional-to-particles",
    "Table I: the RBPF needs O(N) matrix products an iteration",
)
def products_are_linear_in_particles(results: Results) -> list[Part]:
    tracking = next(iter(swept(results.catalogue, "radar").values()))
    model = radar.STUDY.model(results.parameters("radar", tracking))
    few, *_, many = next(iter(particle_sweeps(results.catalogue).values()))

    def products(particles: int) -> float:
        return operation_counts.counted(model, particles)["rbpf"].products

    excess = abs(products(many) / products(few) - many / few)
    return [
        below(
            f"|products at N={many} over those at N={few} - {many / few:g}|",
            excess,
            thresholds(results).products_within,
        )
    ]


@claim(
    CLAIMS,
    "ikf-is-best",
    "Fig. 1: the IKF has a smaller RMSE than BKF-I, BKF-II and RBPF at every p",
)
def ikf_is_best(results: Results) -> list[Part]:
    return [
        smaller_rmse(
            f"p={p}: iekf - {name}", linear(results, point, "iekf"), linear(results, point, name)
        )
        for p, point, name in filters_over_p(results)
    ]


@claim(
    CLAIMS,
    "filters-below-kf",
    "Fig. 1: BKF-I, BKF-II and RBPF have a smaller RMSE than the KF that ignores the losses",
)
def better_than_ignoring_losses(results: Results) -> list[Part]:
    return [
        smaller_rmse(
            f"p={p}: {name} - ekf", linear(results, point, name), linear(results, point, "ekf")
        )
        for p, point, name in filters_over_p(results)
    ]


@claim(
    CLAIMS,
    "filters-close-to-ikf",
    "Fig. 1: the RMSE of BKF-I, BKF-II and RBPF is nearer to that of the IKF than to the KF's",
)
def close_to_ikf(results: Results) -> list[Part]:
    return [
        negative(
            f"p={p}: distance of {name} to iekf - to ekf",
            lambda rmse, best, worst: 2 * rmse - best - worst,
            *(linear(results, point, filter_) for filter_ in (name, "iekf", "ekf")),
        )
        for p, point, name in filters_over_p(results)
    ]


def gain_grows(results: Results, gain: Callable) -> list[Part]:
    """gain(RMSE of the KF, RMSE of the filter) grows from each p to the next."""
    points = swept(results.catalogue, STUDY)
    return [
        negative(
            f"{name}: gain at p={low} - p={high}",
            lambda kf_low, rmse_low, kf_high, rmse_high: (
                gain(kf_low, rmse_low) - gain(kf_high, rmse_high)
            ),
            *(linear(results, points[p], f) for p in (low, high) for f in ("ekf", name)),
        )
        for name in proposed_filters(results.catalogue, STUDY, next(iter(points.values())))
        for low, high in pairwise(points)
    ]


@claim(
    CLAIMS,
    "gain-grows-as-difference",
    "Fig. 1: the gain over the KF, as a difference, grows with p",
)
def difference_grows(results: Results) -> list[Part]:
    return gain_grows(results, lambda kf, rmse: kf - rmse)


@claim(CLAIMS, "gain-grows-as-ratio", "Fig. 1: the gain over the KF, as a ratio, grows with p")
def ratio_grows(results: Results) -> list[Part]:
    return gain_grows(results, lambda kf, rmse: kf / rmse)


@claim(
    CLAIMS,
    "more-particles-smaller-rmse",
    "Fig. 2: up to the critical number of particles, more of them give a smaller RMSE",
)
def more_particles_are_better(results: Results) -> list[Part]:
    critical = thresholds(results).critical_particles
    return [
        smaller_rmse(
            f"p={p}: N={more} - N={less}",
            linear(results, points[more], "rbpf"),
            linear(results, points[less], "rbpf"),
        )
        for p, points in particle_sweeps(results.catalogue).items()
        for less, more in pairwise(n for n in points if n <= critical)
    ]


@claim(
    CLAIMS,
    "gain-slows-beyond-critical-particles",
    "Fig. 2: the RMSE falls less beyond the critical number of particles than up to it",
)
def gain_slows(results: Results) -> list[Part]:
    critical, parts = thresholds(results).critical_particles, []
    for p, points in particle_sweeps(results.catalogue).items():
        fewest, most = min(points), max(points)
        parts.append(
            negative(
                f"p={p}: fall from {critical} to {most} - from {fewest} to {critical}",
                lambda few, some, many: (some - many) - (few - some),
                *(linear(results, points[n], "rbpf") for n in (fewest, critical, most)),
            )
        )
    return parts


@claim(
    CLAIMS,
    "needed-particles-depend-on-p",
    "Fig. 2: how many particles are needed depends on the loss probability",
)
def needed_particles_depend_on_p(results: Results) -> list[Part]:
    few, sweeps = thresholds(results).few_particles, particle_sweeps(results.catalogue)
    low, high, *_ = sweeps
    most = max(sweeps[low])
    numbers = [
        metrics.roots_over_steps(linear(results, sweeps[p][n], "rbpf"))
        for p in (low, high)
        for n in (few, most)
    ]

    def difference(few_low, most_low, few_high, most_high):
        return few_low / most_low - few_high / most_high

    # The claim holds for a difference of either sign, so its size is tested.
    return [
        Part(
            f"relative excess of N={few} over N={most}, p={low} against p={high}: minus its size",
            -abs(difference(*(number.value for number in numbers))),
            float(metrics.jackknife_error(difference(*(n.left_out for n in numbers)))),
        )
    ]


def iteration_time(filter_: str, particles: int, p: float) -> tuple[float, float]:
    """Measured time of an iteration of one trial in microseconds, and its standard error."""
    times = pd.read_csv(TIMES).set_index(["filter", "particles", "loss"])
    time, error = times.loc[(filter_, particles, p), ["microseconds", "error"]].astype(float)
    return time, error


def faster(results: Results, first: str, second: str, number: Callable[..., int]) -> list[Part]:
    """An iteration of `first` takes less time than one of `second`; number(swept) particles."""
    parts = []
    for p, points in particle_sweeps(results.catalogue).items():
        particles = number(points)
        (time, error), (other_time, other_error) = (
            iteration_time(name, particles, p) for name in (first, second)
        )
        parts.append(
            Part(
                f"p={p}, N={particles}: {first} - {second} in us",
                time - other_time,
                float(np.hypot(error, other_error)),
            )
        )
    return parts


@claim(
    CLAIMS,
    "rbpf-time-proportional-to-particles",
    "Fig. 2: the time of an RBPF iteration is proportional to the number of particles",
)
def time_is_proportional(results: Results) -> list[Part]:
    parts = []
    for p, points in particle_sweeps(results.catalogue).items():
        many, few = max(points), max(points) // 10
        ratio = iteration_time("rbpf", many, p)[0] / iteration_time("rbpf", few, p)[0]
        parts.append(
            below(
                f"p={p}: |log10 of time({many}) / time({few}) - {np.log10(many / few):g}|",
                abs(np.log10(ratio) - np.log10(many / few)),
                thresholds(results).proportional_within,
            )
        )
    return parts


@claim(
    CLAIMS,
    "fast-rbpf-slower-with-few-particles",
    "Fig. 2: with the fewest particles the Fast RBPF is slower than the RBPF",
)
def fast_is_slower_with_few(results: Results) -> list[Part]:
    return faster(results, "rbpf", "rbpf_fast", min)


@claim(
    CLAIMS,
    "fast-rbpf-faster-with-many-particles",
    "Fig. 2: with the most particles the Fast RBPF is faster than the RBPF",
)
def fast_is_faster_with_many(results: Results) -> list[Part]:
    return faster(results, "rbpf_fast", "rbpf", max)


@claim(
    CLAIMS,
    "most-triples-are-duplicates",
    "Sec. IV-C: with many particles most triples are duplicates",
)
def most_triples_are_duplicates(results: Results) -> list[Part]:
    share, parts = thresholds(results).duplicates_above, []
    for p, points in particle_sweeps(results.catalogue).items():
        many = max(points)
        distinct = results.each(
            STUDY, points[many], "rbpf_fast", lambda runs: runs.recorded["triples"].mean(axis=1)
        )
        bound = (1 - share) * many
        parts.append(smaller(f"p={p}: distinct of {many} - {bound:g}", distinct, np.full(1, bound)))
    return parts


@claim(
    CLAIMS,
    "rbpf-limit-is-ikf",
    "Sec. V-A: with more particles the RBPF comes arbitrarily near the IKF",
)
def rbpf_approaches_ikf(results: Results) -> list[Part]:
    return [
        smaller_rmse(
            f"p={p}: limit of the RBPF (exact) - iekf",
            linear(results, point, "exact"),
            linear(results, point, "iekf"),
        )
        for p, point in swept(results.catalogue, STUDY, "short-loss=").items()
    ]


@claim(
    CLAIMS,
    "rbpf-limit-is-exact-estimate",
    "Introduction: the RBPF approximates the estimate without knowledge of the losses",
)
def rbpf_approaches_exact(results: Results) -> list[Part]:
    closer, parts = thresholds(results).limit_nearer_by, []
    for point in swept(results.catalogue, STUDY, "short-loss=").values():
        errors = {
            name: results.runs(STUDY, point, name).error
            for name in ("exact", "rbpf", "rbpf_fast", "bkf_2")
        }
        distance = {
            name: (((error - errors["exact"]) ** 2).sum(axis=-1)).mean(axis=1)
            for name, error in errors.items()
        }
        many, few = distance["rbpf_fast"], distance["rbpf"]  # as the point sets their particles
        named = "squared distance to exact: rbpf_fast, of more particles"
        parts.append(smaller(f"{named} - that of rbpf / {closer:g}", many, few / closer))
        parts.append(smaller(f"{named} - that of bkf_2", many, distance["bkf_2"]))
    return parts


@claim(CLAIMS, "ikf-is-stable", "Sec. VI-A: the IKF is mean-square stable for every p < 1")
def ikf_is_stable(results: Results) -> list[Part]:
    """Its mean squared error does not grow from the third quarter of the steps to the last."""
    factor, parts = thresholds(results).bounded_within, []

    def mean_square(runs: Runs, quarter: int) -> np.ndarray:
        squared = linear_losses.squared_error(runs)
        steps = squared.shape[1]
        return squared[:, quarter * steps // 4 : (quarter + 1) * steps // 4].mean(axis=1)

    for p, point in swept(results.catalogue, STUDY).items():
        third, last = (
            results.each(
                STUDY, point, "iekf", lambda runs, quarter=quarter: mean_square(runs, quarter)
            )
            for quarter in (2, 3)
        )
        parts.append(
            smaller(f"p={p}: last quarter - {factor:g} third quarter", last, factor * third)
        )
    return parts
