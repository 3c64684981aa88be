"""Claims on the number of particles, linear system [unknown_losses Sec. IV-C, Fig. 2, Table I]."""

from collections.abc import Callable
from decimal import Decimal
from itertools import pairwise

import numpy as np
import pandas as pd

from repro.papers.unknown_losses import operation_counts
from repro.papers.unknown_losses.claims.linear_losses import STUDY, linear, thresholds
from repro.papers.unknown_losses.points import particle_sweeps, swept
from repro.statistics import metrics
from repro.statistics.paired import independent_error
from repro.studies import radar
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, smaller
from repro.verdicts.rmse import negative, smaller_rmse

CLAIMS: list[Claim] = []
TIMES = "params/measured/unknown_losses_iteration_times.csv"


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
        linear(results, sweeps[p][n], "rbpf", average=True)
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
                independent_error(error, other_error),
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
        # To the last digit on every machine, and without the second that numba takes to start.
        decades, proportional = (float(Decimal(x).log10()) for x in (ratio, many / few))
        parts.append(
            below(
                f"p={p}: |log10 of time({many}) / time({few}) - {proportional:g}|",
                abs(decades - proportional),
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
