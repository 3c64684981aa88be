"""Claims that ignoring both impairments is worst [energy_harvesting Sec. IV-B, an expectation]."""

from repro.papers.energy_harvesting.claims.comparisons import FilterAt, better, of_all_runs
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
    """SPF is less accurate than each of the other filters, over all runs and run by run."""
    parts = []
    for component in study_of(study).components:
        for other in PAPERS_FILTERS:
            if other != "spf":
                pair = FilterAt("base", other), FilterAt("base", "spf")
                name = f"{component}: {other} - spf"
                run_by_run = better(results, study, *pair, component, name)[0]
                parts += [of_all_runs(results, study, *pair, component, name), run_by_run]
    return parts
