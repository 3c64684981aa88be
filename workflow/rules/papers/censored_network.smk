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
