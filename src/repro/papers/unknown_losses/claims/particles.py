"""Claims on the number of particles, linear system [unknown_losses Sec. IV-C, Fig. 2, Table I]."""

from collections.abc import Callable, Mapping
from itertools import pairwise

import numpy as np
import pandas as pd

from repro.kernels import arrays
from repro.papers.unknown_losses.claims.linear_losses import STUDY, linear, thresholds
from repro.papers.unknown_losses.points import particle_sweeps
from repro.statistics import metrics
from repro.studies import radar
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, smaller
from repro.verdicts.equivalence import equivalent
from repro.verdicts.rmse import negative, smaller_rmse

CLAIMS: list[Claim] = []
Sweeps = Mapping[float, Mapping[int, str]]  # as `particle_sweeps` gives them
TIMES = "params/measured/unknown_losses_iteration_times.csv"


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
    "more-particles-smaller-rmse-radar",
    "Sec. I, tried on the radar: more particles give the RBPF a smaller RMSE",
)
def more_particles_are_better_on_radar(results: Results) -> list[Part]:
    parts = []
    for p, points in particle_sweeps(results.catalogue, "radar").items():
        of = {
            n: results.rmse("radar", point, "rbpf_fast", radar.squared_error, average=True)
            for n, point in points.items()
        }
        for less, more in pairwise(of):
            name = f"p={p}: N={more} - N={less}"
            parts.append(smaller_rmse(name, of[more], of[less]))
    return parts


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
    if len(sweeps) < 2:
        raise LookupError("two loss probabilities are needed")
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


def faster(
    first: str, second: str, sweeps: Sweeps, number: Callable[..., int], factor: float = 1.0
) -> list[Part]:
    """An iteration of `first`, with number(swept) particles, takes 1 / factor of the other's."""
    parts, times = [], f"{factor:g} times " if factor != 1 else ""
    for p, points in sweeps.items():
        particles = number(points)
        (time, error), (other_time, other_error) = (
            iteration_time(name, particles, p) for name in (first, second)
        )
        parts.append(
            Part(
                f"p={p}, N={particles}: {times}{first} - {second} in us",
                factor * time - other_time,
                arrays.hypot(factor * error, other_error),
            )
        )
    return parts


@claim(
    CLAIMS,
    "rbpf-time-proportional-to-particles",
    "Fig. 2, measured elsewhere: the time of an RBPF iteration is proportional to its particles",
)
def time_is_proportional(results: Results) -> list[Part]:
    margin, parts = thresholds(results).proportional_within, []
    for p, points in particle_sweeps(results.catalogue).items():
        many, few = max(points), max(points) // 10
        (time, error), (other_time, other_error) = (
            iteration_time("rbpf", particles, p) for particles in (many, few)
        )
        decades = arrays.log10(time / other_time) - arrays.log10(many / few)
        error = arrays.hypot(error / time, other_error / other_time) / arrays.log(10.0)
        name = f"p={p}: log10 of time({many}) / time({few}) - {arrays.log10(many / few):g}"
        parts += equivalent(name, decades, error, margin)
    return parts


@claim(
    CLAIMS,
    "fast-rbpf-slower-with-few-particles",
    "Fig. 2, measured elsewhere: with the fewest particles the Fast RBPF is slower than the RBPF",
)
def fast_is_slower_with_few(results: Results) -> list[Part]:
    return faster("rbpf", "rbpf_fast", particle_sweeps(results.catalogue), min)


@claim(
    CLAIMS,
    "fast-rbpf-faster-with-many-particles",
    "Fig. 2, measured elsewhere: with the most particles the Fast RBPF is greatly faster",
)
def fast_is_faster_with_many(results: Results) -> list[Part]:
    factor = thresholds(results).greatly_faster_by
    return faster("rbpf_fast", "rbpf", particle_sweeps(results.catalogue), max, factor)


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
