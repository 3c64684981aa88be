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
        results=lambda wildcards, output: results_of([wildcards.study], requested=True),
        made_with=lambda wildcards: results_with([wildcards.study], requested=True),
        code=code("repro.papers.censored_network.sensitivity"),
    script:
        "../../scripts/papers/sensitivity.py"


# The geometry, fitted again to Tables I and II: the searches are independent jobs.
CALIBRATIONS += [
    *(LAYOUT.calibration(f"{name}.csv") for name in ("geometry", "left_out", "profile")),
    f"{FIGURES}/censored_network/calibration.png",
]


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
