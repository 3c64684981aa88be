"""Numbers that the reasons for the verdicts on unknown_losses state."""

from collections.abc import Iterable, Mapping

from repro.papers.unknown_losses.claims import inference, linear_losses, particles, radar
from repro.papers.unknown_losses.points import PROPOSED, particle_sweeps, swept
from repro.studies import quadrotor
from repro.tables.results import Results
from repro.verdicts.claims import Part, Test
from repro.verdicts.facts import Fact

IN_PERCENT = 100.0


def _sums(results: Results, filter_: str) -> dict[float, float]:
    """Sum of the RMSE over the steps of the linear system, at each p of Fig. 1."""
    return {
        p: linear_losses.linear(results, point, filter_).value
        for p, point in swept(results.catalogue, "linear_losses").items()
    }


def gains_over_kf(results: Results) -> Mapping[str, float]:
    """How the RMSE of the KF compares with the filters', over p."""
    kf = _sums(results, "ekf")
    of = {name: _sums(results, name) for name in PROPOSED}
    factor = linear_losses.thresholds(results).much_better_by
    least = {p: min(kf[p] / sums[p] for sums in of.values()) for p in kf}
    gap = {p: kf[p] - of["rbpf"][p] for p in kf}
    low, high = sorted(kf)[-2:]
    peaks = [max(kf, key=lambda p, sums=sums: kf[p] / sums[p]) for sums in of.values()]
    enough = [p for p in kf if all(least[q] > factor for q in kf if q >= p)]
    parts = list(linear_losses.difference_grows(results))
    return {
        "much_better_by": factor,
        "much_better_from_p": min(enough, default=float("nan")),
        "least_p": min(kf),
        "least_gain": least[min(kf)],
        "gaps": len(parts),
        "gaps_failing": _deciding(parts, results, "fails"),
        "gaps_undecided": _deciding(parts, results, "undecided"),
        "gap_low_p": low,
        "gap_high_p": high,
        "gap_low": gap[low],
        "gap_high": gap[high],
        "ratio_peak_from": min(peaks),
        "ratio_peak_to": max(peaks),
    }


def _deciding(parts: Iterable[Part], results: Results, verdict: str) -> int:
    return sum(part.verdict(results.tolerance) == verdict for part in parts)


def limit(results: Results) -> Mapping[str, float]:
    """How much worse the limit of the RBPF is than the IKF, in percent of the RMSE."""
    ((p, point),) = swept(results.catalogue, "linear_losses", "short-loss=").items()
    limit_, ikf = (linear_losses.linear(results, point, name).value for name in ("exact", "iekf"))
    return {"limit_p": p, "limit_excess": IN_PERCENT * (limit_ / ikf - 1)}


def iteration_times(results: Results) -> Mapping[str, float]:
    """Of the Fast RBPF over the RBPF's, with the most particles, the largest over p."""
    ratios = []
    for p, points in particle_sweeps(results.catalogue).items():
        fast, plain = (
            particles.iteration_time(name, max(points), p)[0] for name in ("rbpf_fast", "rbpf")
        )
        ratios.append(fast / plain)
    return {"most_particles": max(points), "fast_time_ratio": min(ratios)}


def inferred(results: Results) -> Mapping[str, float]:
    """The smallest share of losses and arrivals that is inferred rightly, in percent, and its p."""
    numbers = {}
    for study in inference.INFERRED:
        shares = {(p, name): s.mean() for p, name, s in inference.inferred(results, study)}
        p, name = min(shares, key=lambda at: shares[at])
        numbers |= {f"inferred_{study}": IN_PERCENT * shares[p, name], f"inferred_{study}_p": p}
    return numbers


def detectable(results: Results) -> Mapping[str, float]:
    """The largest difference that the undecided comparisons of a claim could not decide."""
    tests: dict[str, Test] = {
        "stable_linear": inference.bkf_2_is_more_stable,
        "rbpf_bkf": radar.rbpf_beats_bkf_at_every_p,
        "bkf_1_bkf_2": radar.bkf_1_beats_bkf_2_at_every_p,
        "grows": radar.rmse_grows_with_p,
        "iekf_bkf": radar.iekf_beats_bkf,
        "particles_radar": particles.more_particles_are_better_on_radar,
    }
    numbers: dict[str, float] = {}
    for name, test in tests.items():
        parts = list(test(results))
        open_ = [part for part in parts if part.verdict(results.tolerance) == "undecided"]
        errors = [results.tolerance * part.mcse for part in open_]
        numbers |= {f"{name}_comparisons": len(parts), f"{name}_open": len(open_)}
        numbers[f"{name}_detectable"] = max(errors, default=0.0)
    return numbers


def lost_targets(results: Results) -> Mapping[str, float]:
    """Where BKF-II loses most targets more than BKF-I, in percent of the runs."""
    parts = inference.bkf_2_loses_fewer(results)
    return {"bkf_2_loses_more": IN_PERCENT * max(part.difference for part in parts)}


def bias(results: Results) -> Mapping[str, float]:
    """Altitude that the EKF ignoring losses settles at, by the mean of y, and as it was flown."""
    parameters = results.parameters("quadrotor", "nominal")
    wanted = quadrotor.reference(parameters)[0, 2]
    flown = results.each("quadrotor", "nominal", "ekf", quadrotor.altitude)
    return {
        "altitude_wanted": float(wanted),
        "altitude_expected": float(wanted / (1 - parameters.loss_probability)),
        "altitude_flown": float(flown.mean()),
    }


FACTS: list[Fact] = [
    gains_over_kf,
    limit,
    iteration_times,
    inferred,
    detectable,
    lost_targets,
    bias,
]
