# Beyond the papers: what a mean hides, whether the particles are enough, what a wrong parameter
# costs, and what accuracy costs. One job a table, for all studies: most of each would be its start.
rule tails:
    input:
        lambda wildcards: [
            file
            for study in HEAVY_TAILED
            for file in REGISTRY.run_files(study, [*filter(is_plain, STUDIES[study])])
        ],
    output:
        [LAYOUT.tails(study) for study in HEAVY_TAILED],
    log:
        LAYOUT.job_log("tails"),
    benchmark:
        LAYOUT.timing("tails")
    conda:
        ENVIRONMENT
    params:
        studies=HEAVY_TAILED,
        results=lambda wildcards, output: results_of(HEAVY_TAILED),
        made_with=lambda wildcards: results_with(HEAVY_TAILED),
        code=code("repro.tables.tails", *(f"repro.studies.{study}" for study in HEAVY_TAILED)),
    script:
        "../scripts/tails.py"


rule convergence:
    input:
        lambda wildcards: [
            file
            for study in CONVERGENCE
            for file in REGISTRY.run_files(
                study, own_points(study, "convergence"), table="convergence"
            )
        ],
    output:
        [LAYOUT.convergence(study) for study in CONVERGENCE],
    log:
        LAYOUT.job_log("convergence"),
    benchmark:
        LAYOUT.timing("convergence")
    conda:
        ENVIRONMENT
    params:
        studies={study: printed_particles(study) for study in CONVERGENCE},
        results=lambda wildcards, output: results_of(CONVERGENCE, table="convergence"),
        made_with=lambda wildcards: results_with(CONVERGENCE, table="convergence"),
        code=code("repro.tables.convergence", *(f"repro.studies.{s}" for s in CONVERGENCE)),
    script:
        "../scripts/convergence.py"


rule mismatch:
    input:
        lambda wildcards: [
            file
            for study in MISMATCH
            for find in (REGISTRY.run_files, REGISTRY.log_marks)
            for file in find(study, own_points(study, "mismatch"), table="mismatch")
        ],
    output:
        [LAYOUT.mismatch(study) for study in MISMATCH],
    log:
        LAYOUT.job_log("mismatch"),
    benchmark:
        LAYOUT.timing("mismatch")
    conda:
        ENVIRONMENT
    params:
        studies=MISMATCH,
        results=lambda wildcards, output: results_of(MISMATCH, table="mismatch"),
        made_with=lambda wildcards: results_with(MISMATCH, table="mismatch"),
        code=code("repro.tables.mismatch", *(f"repro.studies.{study}" for study in MISMATCH)),
    script:
        "../scripts/mismatch.py"


# Of this machine: neither in the manifest nor under figures/, which a run must leave as they are.
rule cost:
    input:
        rankings=[LAYOUT.ranking(study) for study in STUDIES],
        convergence=[LAYOUT.convergence(study) for study in CONVERGENCE],
    output:
        tables=[LAYOUT.cost(study) for study in STUDIES],
        pictures=[LAYOUT.cost(study, "png") for study in STUDIES],
    log:
        LAYOUT.job_log("cost"),
    benchmark:
        LAYOUT.timing("cost")
    conda:
        ENVIRONMENT
    params:
        studies={
            study: LAYOUT.convergence(study) if study in CONVERGENCE else None for study in STUDIES
        },
        results=lambda wildcards, output: results_of([*STUDIES], table="convergence"),
        made_with=lambda wildcards: results_with([*STUDIES], table="convergence"),
        sizes=lambda wildcards: {
            study: {name: sizes_of(point) for name, point in points.items()}
            for study, points in STUDIES.items()
        },
        code=code("repro.plot.cost", "repro.tables.cost", "repro.workflow.timings"),
    script:
        "../scripts/cost.py"


# What these tables show, in sentences; and which claims as many runs as the paper's would decide.
rule findings:
    input:
        rules.tails.output,
        rules.convergence.output,
        rules.mismatch.output,
        claims=[LAYOUT.claims(paper) for paper in JUDGED],
    output:
        decidable=LAYOUT.page("decidable.csv"),
        findings=LAYOUT.page("findings.csv"),
    log:
        LAYOUT.job_log("findings"),
    benchmark:
        LAYOUT.timing("findings")
    conda:
        ENVIRONMENT
    params:
        printed={
            study: trials
            for paper in PAPERS.values()
            for study, trials in paper.printed_trials.items()
        },
        papers={
            paper: {
                "tails": [study for study in HEAVY_TAILED if study in content.studies],
                "convergence": [study for study in CONVERGENCE if study in content.studies],
                "mismatch": [study for study in MISMATCH if study in content.studies],
            }
            for paper, content in PAPERS.items()
        },
        results=lambda wildcards: results_of([*STUDIES]),
        code=code("repro.pages.findings", "repro.verdicts.decidable"),
    script:
        "../scripts/findings.py"
