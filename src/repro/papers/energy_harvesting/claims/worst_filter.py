"""Claims that ignoring both impairments is worst [energy_harvesting Sec. IV-B, an expectation]."""

from repro.papers.energy_harvesting.claims.comparisons import FilterAt, better
from repro.papers.energy_harvesting.compared import PAPERS_FILTERS, study_of
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim

CLAIMS: list[Claim] = []


@claim(
    CLAIMS,
    "spf-worst-in-2d",
    "Sec. IV-B: In the plane SPF, which ignores both effects, is the least accurate filter.",
)
def worst_in_the_plane(results: Results) -> list[Part]:
    return ignoring_is_worst(results, "rss_2d")


@claim(
    CLAIMS,
    "spf-worst-in-3d",
    "Sec. IV-B: In space SPF, which ignores both effects, is the least accurate filter.",
)
def worst_in_space(results: Results) -> list[Part]:
    return ignoring_is_worst(results, "rss_3d")


@claim(
    CLAIMS,
    "spf-worst-in-scalar-example",
    "Sec. IV-B: In the scalar example, too, SPF is the least accurate filter.",
)
def worst_in_one_dimension(results: Results) -> list[Part]:
    return ignoring_is_worst(results, "ungm")


def ignoring_is_worst(results: Results, study: str) -> list[Part]:
    """SPF is less accurate than each of the other filters, in the mean and run by run."""
    return [
        part
        for component in study_of(study).components
        for other in PAPERS_FILTERS
        if other != "spf"
        for part in better(
            results,
            study,
            FilterAt("base", other),
            FilterAt("base", "spf"),
            component,
            f"{component}: {other} - spf",
        )[:2]
    ]
