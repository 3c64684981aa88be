# Whether the filters' own covariances are true, and how far their errors are from the least that
# is possible: the studies of a paper in one job.
CONSISTENCY = {
    paper: [study for study in content.studies if content.consistency[study]]
    for paper, content in PAPERS.items()
}
CONSISTENCY_FILES = [
    file(study)
    for studies in CONSISTENCY.values()
    for study in studies
    for file in (LAYOUT.consistency, LAYOUT.bounds)
]

for paper, studies in CONSISTENCY.items():
    if not studies:
        continue

    rule:
        name:
            f"consistency_{paper}"
        input:
            [REGISTRY.run_files(s, judged_points(s)) for s in studies],
            [REGISTRY.log_marks(s, judged_points(s)) for s in studies],
        output:
            consistency=[LAYOUT.consistency(study) for study in studies],
            bounds=[LAYOUT.bounds(study) for study in studies],
            summary=report(
                LAYOUT.consistency_summary(paper),
                category="Verdicts",
                labels={"table": f"{paper}: covariances and bounds"},
            ),
        log:
            LAYOUT.job_log("consistency", paper),
        benchmark:
            LAYOUT.timing("consistency", paper)
        conda:
            ENVIRONMENT
        params:
            results=lambda wildcards, output, studies=studies: results_of(studies),
            made_with=lambda wildcards, studies=studies: results_with(studies),
            studies=studies,
            code=code(
                "repro.tables.bounds",
                "repro.pages.consistency",
                *(f"repro.studies.{s}" for s in studies),
            ),
        script:
            "../scripts/consistency.py"
