"""Numbers in the reasons for the verdicts of [energy_harvesting]."""

import numpy as np

from repro.papers.energy_harvesting.claims.comparisons import (
    FilterAt,
    combination,
    lost,
    squared,
)
from repro.papers.energy_harvesting.claims.transmissions import probability, share_sent
from repro.papers.energy_harvesting.compared import PROPOSED, RIVALS, SWEPT_STUDY, study_of
from repro.statistics import metrics
from repro.tables.results import Results
from repro.verdicts.facts import Fact

SMALL_SQUARE = "reading-layout=square40@base"
MORE_PARTICLES = "reading-layout=square40-particles=5000@base"


def lemma_1(results: Results) -> dict[str, float]:
    """Transmission probability of Lemma 1, of the exact chain and of the logs."""
    sent = share_sent(results, SWEPT_STUDY, "base").mean()
    found = {"pi_1_logs": float(sent)}
    for name, study, point in (
        ("pi_1", SWEPT_STUDY, "base"),
        ("identity", "ungm", "harvest=identity"),
    ):
        lemma, exact = (probability(results, study, point, rule) for rule in ("lemma1", "exact"))
        found |= {f"{name}_lemma": lemma.mean(), f"{name}_exact": exact.mean()}
        found |= {f"{name}_lemma_at_end": lemma[-1], f"{name}_exact_at_end": exact[-1]}
    return {name: float(value) for name, value in found.items()}


def worst_filter(results: Results) -> dict[str, float]:
    """How often the filters that ignore lost packets lose the target in the plane, and how far."""
    found = {}
    for name in ("pf_ross", "spf"):
        at = FilterAt("base", name)
        found[f"lost_{name}"] = float(lost(results, "rss_2d", at).mean())
        found[f"rmse_{name}"] = rmse(results, "rss_2d", at)
    return found


def small_square(results: Results) -> dict[str, float]:
    """PF-ROSS-EH and PF-EH on the square of side 40 m, with few particles and with many."""
    settings = MORE_PARTICLES.partition("@")[0]
    found = {"more_particles": float(settings.rpartition("=")[2])}
    for where, point in (("small_square", SMALL_SQUARE), ("more_particles", MORE_PARTICLES)):
        for name in (PROPOSED, "pf_eh"):
            at = FilterAt(point, name)
            found[f"{where}_rmse_{name}"] = rmse(results, "rss_2d", at)
            found[f"{where}_lost_{name}"] = float(lost(results, "rss_2d", at).mean())
    return found


def lost_runs_in_sweeps(results: Results) -> dict[str, float]:
    """What the run of the largest error does to a mean over all runs of Figs. 8 and 10."""
    found = {}
    for name, better, worse in (
        ("pi", "base", "harvest=pi_2"),
        ("gamma", "gamma=0.5", "gamma=0.8"),
    ):
        errors = [
            squared(results, SWEPT_STUDY, FilterAt(point, PROPOSED), "position")
            for point in (better, worse)
        ]
        kept = np.ones(errors[0].trials, dtype=bool)
        kept[np.argmax(errors[1].mean_over_steps())] = False
        for which, of in (("all", errors), ("but_one", [error.only(kept) for error in errors])):
            part = combination("", (1, -1), of)
            found[f"{name}_{which}_better"] = metrics.roots_over_steps(of[0]).value
            found[f"{name}_{which}_worse"] = metrics.roots_over_steps(of[1]).value
            found[f"{name}_{which}_errors"] = abs(part.difference) / part.mcse
    return found


def next_best(results: Results) -> dict[str, float]:
    """How many times larger the RMSE of the best rival is, over all runs."""
    found = {"much_better": results.analysis("rss_2d").much_better}
    for study in ("rss_2d", "rss_3d"):
        for component in study_of(study).components:
            proposed, *rivals = (
                rmse(results, study, FilterAt("base", name), component)
                for name in (PROPOSED, *RIVALS)
            )
            found[f"ratio_{component}_{study[-2:]}"] = min(rivals) / proposed
    return found


def rmse(results: Results, study: str, at: FilterAt, component: str = "position") -> float:
    """Mean over k of RMSE(k), over all runs."""
    return metrics.roots_over_steps(squared(results, study, at, component)).value


FACTS: list[Fact] = [lemma_1, worst_filter, small_square, lost_runs_in_sweeps, next_best]
