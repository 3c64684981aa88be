"""Claims on the losses that the filters infer [unknown_losses Sec. I, III-B, IV-C, V-A]."""

from collections.abc import Callable, Iterator

import numpy as np

from repro.papers.unknown_losses.points import (
    most_runs,
    plain_points,
    proposed_filters,
    rbpf_of,
    swept,
)
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.studies import linear_losses, radar
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, smaller
from repro.verdicts.rmse import smaller_rmse

CLAIMS: list[Claim] = []
Share = Callable[[Runs], np.ndarray]
INFERRED: dict[str, Share] = {
    "linear_losses": linear_losses.inferred_rightly,
    "radar": radar.inferred_rightly,
}


def inferred(results: Results, study: str) -> Iterator[tuple[float, str, np.ndarray]]:
    """Loss probability, name, and share of steps that it infers rightly, of each filter and p."""
    for point in swept(results.catalogue, study).values():
        p = results.parameters(study, point).loss_probability
        for name in proposed_filters(results.catalogue, study, point):
            yield p, name, results.each(study, point, name, INFERRED[study])


def mostly_right(results: Results, study: str) -> list[Part]:
    """Each of the paper's filters infers more than so many of the losses and arrivals rightly."""
    enough = results.analysis(study).inferred_above
    return [
        smaller(f"p={p}, {name}: {enough:g} - share inferred rightly", np.array([enough]), share)
        for p, name, share in inferred(results, study)
    ]


@claim(
    CLAIMS,
    "losses-inferred-linear",
    "Sec. I, V-A: BKF-I, BKF-II and RBPF infer the losses rightly, linear system, at every p",
)
def inferred_in_linear_system(results: Results) -> list[Part]:
    return mostly_right(results, "linear_losses")


@claim(
    CLAIMS,
    "losses-inferred-radar",
    "Sec. I, V-A: BKF-I, BKF-II and RBPF infer the losses rightly, radar, at every p",
)
def inferred_on_radar(results: Results) -> list[Part]:
    return mostly_right(results, "radar")


@claim(
    CLAIMS,
    "losses-inferred-better-than-blindly",
    "Sec. I: BKF-I, BKF-II and RBPF infer more losses rightly than who knows p alone, at every p",
)
def better_than_blindly(results: Results) -> list[Part]:
    return [
        smaller(f"{study}, p={p}: guess - {name}", np.array([max(p, 1 - p)]), share)
        for study in INFERRED
        for p, name, share in inferred(results, study)
    ]


def unequal(results: Results, study: str, point: str, first: str, second: str) -> Part:
    """Errors of two filters are the same numbers, in the single precision of the files."""
    one, other = (results.runs(study, point, name).error for name in (first, second))
    differ = (one != other) & ~(np.isnan(one) & np.isnan(other))  # NaN: not kept
    return below(f"{study}, {point}: errors of {first} unequal to {second}'s", differ.sum(), 1)


@claim(
    CLAIMS,
    "bkf-reduce-to-iekf",
    "Sec. I, III-B: where the losses are known for certain, BKF-I and BKF-II are the IEKF",
)
def bkf_reduce_to_iekf(results: Results) -> list[Part]:
    """Without losses, and where y(k) shows beyond doubt whether it was lost."""
    points = [
        point
        for point in plain_points(results.catalogue, "linear_losses")
        if point == "no-loss" or point.startswith("certain-")
    ]
    if not points:
        raise LookupError("no point without doubt of the losses")
    return [
        unequal(results, "linear_losses", point, name, "iekf")
        for point in points
        for name in ("bkf_1", "bkf_2")
    ]


@claim(
    CLAIMS,
    "fast-rbpf-is-rbpf",
    "Sec. IV-C: Algorithm 4 returns the same estimates as Algorithm 3",
)
def algorithms_agree(results: Results) -> list[Part]:
    return [
        unequal(results, study, point, "rbpf_fast", "rbpf")
        for study in INFERRED
        for point in plain_points(results.catalogue, study)
        if {"rbpf", "rbpf_fast"} <= set(results.catalogue[study][point])
        and not point.startswith("short-")  # there they have different numbers of particles
    ]


@claim(
    CLAIMS,
    "rbpf-below-standard-particle-filter",
    "Sec. IV-A: with as many particles the RBPF has a smaller RMSE than a standard particle filter",
)
def rbpf_beats_particle_filter(results: Results) -> list[Part]:
    errors = {"linear_losses": linear_losses.squared_error, "radar": radar.squared_error}
    return [
        smaller_rmse(
            f"{study}, {point}: rbpf - sir_losses",
            *(
                results.rmse(study, point, name, error, average=True)
                for name in (rbpf_of(results.catalogue, study, point), "sir_losses")
            ),
        )
        for study, error in errors.items()
        for point in plain_points(results.catalogue, study)
        if "sir_losses" in results.catalogue[study][point]
    ]


def deviation(name: str, first: np.ndarray, second: np.ndarray) -> Part:
    """The standard deviation over the runs of `first` is the smaller, (trials,) each, paired."""

    def of(values: np.ndarray) -> tuple[float, np.ndarray]:
        rest = metrics.leave_one_out(np.stack([values, values**2], axis=1), lambda means: means)
        return float(values.std()), np.sqrt(rest[:, 1] - rest[:, 0] ** 2)

    (one, left), (other, other_left) = of(first), of(second)
    return Part(name, one - other, float(metrics.jackknife_error(left - other_left)))


@claim(
    CLAIMS,
    "bkf-2-more-stable-linear",
    "Sec. V-A: BKF-II is more stable than BKF-I: its mean squared error varies less over the runs",
)
def bkf_2_is_more_stable(results: Results) -> list[Part]:
    parts = []
    for p, point in swept(results.catalogue, "linear_losses").items():
        errors = (
            results.each("linear_losses", point, name, linear_losses.squared_error)
            for name in ("bkf_2", "bkf_1")
        )
        runs = (squared.mean_over_steps() for squared in errors)
        parts.append(deviation(f"p={p}: deviation of bkf_2 - of bkf_1", *runs))
    return parts


@claim(
    CLAIMS,
    "bkf-2-more-stable-radar",
    "Sec. V-A: BKF-II is more stable than BKF-I: it loses fewer targets, radar",
)
def bkf_2_loses_fewer(results: Results) -> list[Part]:
    """At every p, and on average over them: the runs of the points have the same noise."""
    analysis = results.analysis("radar")

    def lost(point: str, name: str) -> np.ndarray:
        found = results.each("radar", point, name, lambda runs: radar.STUDY.lost(runs, analysis))
        return found.astype(float)

    points = most_runs(results.catalogue, "radar").values()
    shares = {point: (lost(point, "bkf_2"), lost(point, "bkf_1")) for point in points}
    overall = (np.mean(of_all, axis=0) for of_all in zip(*shares.values(), strict=True))
    return [
        smaller("mean over p: share of lost runs, bkf_2 - bkf_1", *overall),
        *(
            smaller(f"{point}: share of lost runs, bkf_2 - bkf_1", *s)
            for point, s in shares.items()
        ),
    ]
