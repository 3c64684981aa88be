"""Claims about the accuracy of PF-ROSS-EH [energy_harvesting Figs. 2 and 6-13]."""

import numpy as np

from repro.papers.energy_harvesting.claims.comparisons import (
    FilterAt,
    best_of,
    near,
    of_all_runs,
    ordered,
    pairs,
    squared,
)
from repro.papers.energy_harvesting.compared import (
    HARVESTS,
    IDEAL,
    PAPERS_FILTERS,
    PROPOSED,
    RIVALS,
    SATURATIONS,
    SENSORS,
    study_of,
)
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, most

CLAIMS: list[Claim] = []


@claim(
    CLAIMS,
    "pf-ross-eh-beats-spf-in-scalar-example",
    "Fig. 2: In the scalar example PF-ROSS-EH is more accurate than SPF.",
)
def scalar_example(results: Results) -> list[Part]:
    return best_of(results, "ungm", PROPOSED, ["spf"])


@claim(
    CLAIMS,
    "pf-ross-eh-best-in-2d",
    "Figs. 6-7: In the plane PF-ROSS-EH is more accurate than PF-ROSS, PF-EH and SPF.",
)
def best_in_the_plane(results: Results) -> list[Part]:
    return beats_rivals(results, "rss_2d")


@claim(
    CLAIMS,
    "pf-ross-eh-much-better-in-2d",
    "Figs. 6-7: In the plane PF-ROSS-EH is much more accurate than PF-ROSS, PF-EH and SPF.",
)
def much_better_in_the_plane(results: Results) -> list[Part]:
    return beats_rivals(results, "rss_2d", results.analysis("rss_2d").much_better)


@claim(
    CLAIMS,
    "pf-ross-eh-best-in-3d",
    "Figs. 12-13: In space PF-ROSS-EH is more accurate than PF-ROSS, PF-EH and SPF.",
)
def best_in_space(results: Results) -> list[Part]:
    return beats_rivals(results, "rss_3d")


@claim(
    CLAIMS,
    "pf-ross-eh-much-better-in-3d",
    "Figs. 12-13: In space PF-ROSS-EH is much more accurate than PF-ROSS, PF-EH and SPF.",
)
def much_better_in_space(results: Results) -> list[Part]:
    return beats_rivals(results, "rss_3d", results.analysis("rss_3d").much_better)


def beats_rivals(results: Results, study: str, factor: float = 1.0) -> list[Part]:
    """`factor` times the error of PF-ROSS-EH is below its rivals', over all runs as well."""
    return [
        *best_of(results, study, PROPOSED, RIVALS, factor),
        *(
            of_all_runs(results, study, *pair, factor)
            for pair in pairs(study, PROPOSED, RIVALS, factor)
        ),
    ]


@claim(
    CLAIMS,
    "spf-im-best-in-2d",
    "Figs. 6-7: In the plane SPF-IM, which sees unimpaired measurements, is the most accurate.",
)
def ideal_is_best_in_the_plane(results: Results) -> list[Part]:
    return ideal_is_best(results, "rss_2d")


@claim(
    CLAIMS,
    "spf-im-best-in-3d",
    "Figs. 12-13: In space SPF-IM, which sees unimpaired measurements, is the most accurate.",
)
def ideal_is_best_in_space(results: Results) -> list[Part]:
    return ideal_is_best(results, "rss_3d")


def ideal_is_best(results: Results, study: str) -> list[Part]:
    """SPF-IM is more accurate than every other filter."""
    return best_of(results, study, IDEAL, [name for name in PAPERS_FILTERS if name != IDEAL])


@claim(
    CLAIMS,
    "pf-ross-eh-near-spf-im",
    "Figs. 6-7: In the plane the error of PF-ROSS-EH approaches that of SPF-IM.",
)
def approaches_ideal_in_the_plane(results: Results) -> list[Part]:
    return approaches_ideal(results, "rss_2d")


@claim(
    CLAIMS,
    "pf-ross-eh-near-spf-im-in-3d",
    "Figs. 12-13: In space the error of PF-ROSS-EH approaches that of SPF-IM.",
)
def approaches_ideal_in_space(results: Results) -> list[Part]:
    return approaches_ideal(results, "rss_3d")


def approaches_ideal(results: Results, study: str) -> list[Part]:
    """PF-ROSS-EH and SPF-IM differ by less than the factor that `approaches` is read as."""
    factor = results.analysis(study).approaches_within
    return [
        part
        for component in study_of(study).components
        for part in near(results, study, PROPOSED, IDEAL, component, factor)
    ]


@claim(
    CLAIMS,
    "pf-ross-eh-tracks-in-2d",
    "Fig. 3: In the plane PF-ROSS-EH tracks the target well.",
)
def tracks_in_the_plane(results: Results) -> list[Part]:
    return tracks(results, "rss_2d")


@claim(
    CLAIMS,
    "pf-ross-eh-tracks-in-3d",
    "Fig. 11: In space PF-ROSS-EH tracks the target well.",
)
def tracks_in_space(results: Results) -> list[Part]:
    return tracks(results, "rss_3d")


def tracks(results: Results, study: str) -> list[Part]:
    """In nearly every run: which run the paper shows is not known."""
    analysis = results.analysis(study)
    error = squared(results, study, FilterAt("base", PROPOSED), "position").mean_over_steps()
    within = f"{study}: runs with an rms position error below {analysis.tracks_within:g} m"
    return [most(within, np.sqrt(error) < analysis.tracks_within, analysis.tracks_share)]


@claim(
    CLAIMS,
    "error-rises-with-saturation",
    "Fig. 8: The error of PF-ROSS-EH rises with the probability of saturation.",
)
def saturation_hurts(results: Results) -> list[Part]:
    return ordered(results, SATURATIONS)


@claim(
    CLAIMS,
    "error-falls-with-sensors",
    "Fig. 9: The error of PF-ROSS-EH falls with the number of sensors.",
)
def sensors_help(results: Results) -> list[Part]:
    return ordered(results, SENSORS, rising=False)


@claim(
    CLAIMS,
    "error-smaller-under-pi-1",
    "Fig. 10: The error of PF-ROSS-EH is smaller under the harvest matrix Pi_1 than under Pi_2.",
)
def harvest_helps(results: Results) -> list[Part]:
    return ordered(results, HARVESTS)
