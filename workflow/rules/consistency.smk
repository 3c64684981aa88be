# Whether the filters' own covariances are true: the studies of a paper in one job.
CONSISTENCY = {
    paper: [study for study in content.studies if content.consistency[study]]
    for paper, content in PAPERS.items()
}
CONSISTENCY_FILES = [LAYOUT.consistency(s) for studies in CONSISTENCY.values() for s in studies]

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
            **{study: LAYOUT.consistency(study) for study in studies},
            summary=report(
                LAYOUT.consistency_summary(paper),
                category="Verdicts",
                labels={"table": f"{paper}: are the filters' covariances true?"},
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
            code=code("repro.pages.consistency", *(f"repro.studies.{s}" for s in studies)),
        script:
            "../scripts/consistency.py"
