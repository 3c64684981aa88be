# Which published order survives which unstated assumption. On request: some of its runs take a
# minute.
rule sensitivity:
    input:
        runs=lambda wildcards: REGISTRY.run_files(
            wildcards.study,
            ["base", *filter(is_reading, STUDIES[wildcards.study])],
            requested=True,
        ),
    output:
        LAYOUT.table("{study}_sensitivity"),
    log:
        LAYOUT.job_log("sensitivity", "{study}"),
    benchmark:
        LAYOUT.timing("sensitivity", "{study}")
    wildcard_constraints:
        study="|".join(PAPERS["censored_network"].studies),
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: results_of([wildcards.study], requested=True),
        code=code("repro.papers.censored_network.sensitivity"),
    script:
        "../../scripts/papers/sensitivity.py"


# The geometry, fitted again to Tables I and II: the searches are independent jobs.
CALIBRATIONS += [
    *(LAYOUT.calibration(f"{name}.csv") for name in ("geometry", "left_out", "profile")),
    f"{FIGURES}/censored_network/calibration.png",
]


def searched_fits():
    """A file for each search: of all rows of the tables, and of all rows but one."""
    paper = PAPERS["censored_network"]
    starts, left_out_starts = (paper.calibration[of] for of in ("starts", "left_out_starts"))
    names = [("all", start) for start in range(starts + 1)]
    for study in paper.studies:
        for filter_ in paper.ranking[study].papers:
            names += [(f"{study}-{filter_}", start + 1) for start in range(left_out_starts)]
    return [LAYOUT.calibration("fits", left_out, f"{start}.npz") for left_out, start in names]


def searched_network():
    """Named parameter of the jobs that search: the studies, the search and its seed."""
    paper = PAPERS["censored_network"]
    return {
        "points": {study: plain_points(study)["base"] for study in paper.studies},
        "search": paper.calibration,
        "budget": RUN.budget,
        "seed": RUN.root_seed,
    }


def searched_code(module):
    """Parameter: the code of a module of the search, with the studies and their filters."""
    paper = PAPERS["censored_network"]
    filters = {name for study in paper.studies for name in paper.ranking[study].papers}
    return code(
        f"repro.papers.censored_network.{module}",
        *(f"repro.studies.{study}" for study in paper.studies),
        *(f"repro.filters.{name}" for name in sorted(filters)),
    )


rule geometry_screen:
    input:
        published="params/published/censored_network.csv",
    output:
        LAYOUT.calibration("screen.csv"),
    log:
        LAYOUT.job_log("geometry_screen"),
    benchmark:
        LAYOUT.timing("geometry_screen")
    conda:
        ENVIRONMENT
    params:
        network=searched_network(),
        code=searched_code("calibration_search"),
    script:
        "../../scripts/papers/geometry_screen.py"


rule geometry_search:
    input:
        published=rules.geometry_screen.input.published,
        screened=rules.geometry_screen.output[0],
    output:
        LAYOUT.calibration("fits", "{left_out}", "{start}.npz"),
    log:
        LAYOUT.job_log("geometry_search", "{left_out}", "{start}"),
    benchmark:
        LAYOUT.timing("geometry_search", "{left_out}", "{start}")
    wildcard_constraints:
        left_out="all|[a-z_]+-[a-z_]+",
        start="[0-9]+",
    conda:
        ENVIRONMENT
    params:
        network=searched_network(),
        code=searched_code("calibration_search"),
    script:
        "../../scripts/papers/geometry_search.py"


rule geometry_profile:
    input:
        published=rules.geometry_screen.input.published,
    output:
        LAYOUT.calibration("profile.csv"),
    log:
        LAYOUT.job_log("geometry_profile"),
    benchmark:
        LAYOUT.timing("geometry_profile")
    conda:
        ENVIRONMENT
    params:
        network=searched_network(),
        code=searched_code("calibration_tables"),
    script:
        "../../scripts/papers/geometry_profile.py"


rule geometry:
    input:
        published=rules.geometry_screen.input.published,
        fits=searched_fits(),
    output:
        geometry=LAYOUT.calibration("geometry.csv"),
        left_out=LAYOUT.calibration("left_out.csv"),
    log:
        LAYOUT.job_log("geometry"),
    benchmark:
        LAYOUT.timing("geometry")
    conda:
        ENVIRONMENT
    params:
        network=searched_network(),
        tolerance=RUN.tolerance,
        code=searched_code("calibration_tables"),
    script:
        "../../scripts/papers/geometry.py"
