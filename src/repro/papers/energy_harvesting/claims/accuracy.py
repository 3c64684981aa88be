"""Claims about the accuracy of PF-ROSS-EH [energy_harvesting Figs. 2 and 6-13]."""

from repro.papers.energy_harvesting.claims.comparisons import (
    FilterAt,
    best_of,
    combination,
    lost,
    ordered,
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
from repro.verdicts.claims import Claim, Part, claim

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
    return best_of(results, "rss_2d", PROPOSED, RIVALS)


@claim(
    CLAIMS,
    "pf-ross-eh-best-in-3d",
    "Figs. 12-13: In space PF-ROSS-EH is more accurate than PF-ROSS, PF-EH and SPF.",
)
def best_in_space(results: Results) -> list[Part]:
    return best_of(results, "rss_3d", PROPOSED, RIVALS)


@claim(
    CLAIMS,
    "spf-im-best-in-2d",
    "Figs. 6-7: SPF-IM, which sees unimpaired measurements, is the most accurate filter.",
)
def ideal_is_best(results: Results) -> list[Part]:
    others = [name for name in PAPERS_FILTERS if name != IDEAL]
    return best_of(results, "rss_2d", IDEAL, others)


@claim(
    CLAIMS,
    "pf-ross-eh-near-spf-im",
    "Figs. 6-7: PF-ROSS-EH approaches SPF-IM: it is nearer to it than to PF-ROSS, PF-EH and SPF.",
)
def approaches_ideal(results: Results) -> list[Part]:
    parts, study = [], "rss_2d"
    for component in study_of(study).components:
        for other in RIVALS:
            filters = [FilterAt("base", name) for name in (PROPOSED, IDEAL, other)]
            errors = [squared(results, study, filter_at, component) for filter_at in filters]
            kept = ~lost(results, study, *filters)
            name = f"{component}: 2 {PROPOSED} - {IDEAL} - {other}"
            parts.append(combination(f"{name}, all runs", (2, -1, -1), errors))
            errors = [error.only(kept) for error in errors]
            parts.append(combination(f"{name}, runs not lost", (2, -1, -1), errors))
    return parts


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
