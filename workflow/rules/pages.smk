# Stops 7 and 8 of the data, and what a reader asks for: pages, manifest, views, logs recorded elsewhere, archive.
rule assumptions:
    input:
        files=PARAMETER_FILES,
        published=[f"params/published/{paper}.csv" for paper in JUDGED],
        tables=[LAYOUT.table(study) for study in STUDIES],
        verdicts=[] if SMOKE else [rules.diff.output.csv, rules.diff.output.robustness],
    output:
        LAYOUT.page("assumptions.md"),
    log:
        LAYOUT.job_log("assumptions"),
    conda:
        ENVIRONMENT
    params:
        papers={
            paper: {
                "parameters": f"params/{paper}.yaml",
                "published": f"params/published/{paper}.csv",
                "studies": {study: plain_points(study) for study in content.studies},
                "tables": {study: LAYOUT.table(study) for study in content.studies},
            }
            for paper, content in PAPERS.items()
            if paper in JUDGED
        },
        verdicts=(
            {}
            if SMOKE
            else {"diff": LAYOUT.page("diff.csv"), "robustness": LAYOUT.page("robustness.csv")}
        ),
        tolerance=RUN.tolerance,
        code=code("repro.pages.assumptions"),
    script:
        "../scripts/assumptions.py"


# The same bytes as docs/verdicts, which is committed: cp results/verdicts/*.md docs/verdicts/
rule paper_verdicts:
    input:
        diff=LAYOUT.page("diff.csv"),
        joint=LAYOUT.joint(),
        scripts=lambda wildcards: figure_scripts(wildcards.paper),
        findings=LAYOUT.page("findings.csv"),
        consistency=lambda wildcards: (
            LAYOUT.consistency_summary(wildcards.paper) if CONSISTENCY[wildcards.paper] else []
        ),
    output:
        LAYOUT.verdicts(),
    log:
        LAYOUT.job_log("paper_verdicts", "{paper}"),
    conda:
        ENVIRONMENT
    params:
        title=lambda wildcards: (
            f"{PAPERS[wildcards.paper].authors}: {PAPERS[wildcards.paper].title}"
        ),
        code=code("repro.pages.paper_verdicts"),
    script:
        "../scripts/paper_verdicts.py"


rule gallery:
    input:
        scripts=sorted(str(path) for path in Path("figures").glob("*/*.py")),
    output:
        f"{FIGURES}/README.md",
    log:
        LAYOUT.job_log("gallery"),
    conda:
        ENVIRONMENT
    params:
        titles={"overview": "All papers."}
        | {paper: f"{content.authors}: {content.title}." for paper, content in PAPERS.items()},
        code=code("repro.pages.gallery"),
    script:
        "../scripts/gallery.py"


rule manifest:
    input:
        parameters=["params/run.yaml", *PARAMETER_FILES, *rules.diff.input.published],
        tables=[
            [] if SMOKE else [rules.diff.output, rules.diff.input.claims],
            [] if SMOKE else [rules.diff.input.facts, rules.diff.input.joint],
            [] if SMOKE else [LAYOUT.verdicts(paper) for paper in JUDGED],
            [] if SMOKE else [rules.tails.output, rules.convergence.output, rules.mismatch.output],
            [] if SMOKE else rules.findings.output,
            rules.diff.input.tables,
            rules.parameters.output,
            rules.assumptions.output,
            [LAYOUT.curves(study) for study in STUDIES],
            [LAYOUT.ranking(study) for study in STUDIES],
            [] if SMOKE else CONSISTENCY_FILES,
        ],
        figures=[*figure_files(), *study_figure_files(), rules.gallery.output],
    output:
        LAYOUT.page("manifest.json"),
    log:
        LAYOUT.job_log("manifest"),
    conda:
        ENVIRONMENT
    params:
        # The tables are made of all of them: named here, not as input, which would take long.
        logs=lambda wildcards, output: [f for s in STUDIES for f in REGISTRY.log_files(s)],
        commit=commit(),
        source=source_digest(),
        seed=RUN.root_seed,
        code=code("repro.provenance.manifest"),
    script:
        "../scripts/manifest.py"


rule verify:
    input:
        diff=LAYOUT.page("diff.csv"),
        manifest=LAYOUT.page("manifest.json"),
    log:
        LAYOUT.job_log("verify"),
    conda:
        ENVIRONMENT
    script:
        "../scripts/verify.py"


rule timings:
    input:
        LAYOUT.page("manifest.json"),
    log:
        LAYOUT.job_log("timings"),
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: str(LAYOUT.root),
    script:
        "../scripts/timings.py"


rule view:
    input:
        logs=lambda wildcards: REGISTRY.log_files(wildcards.study, [wildcards.point]),
    output:
        view=f"{LAYOUT.view()}.mcap",
        layout=f"{LAYOUT.view()}.layout.json",
    log:
        LAYOUT.job_log("view", "{study}", "{point}", "{trial}"),
    wildcard_constraints:
        trial="[0-9]+",
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: results_of([wildcards.study]),
        filters=point_filters,
        code=lambda wildcards: or_exit(
            code_digest,
            "repro.inspect.view",
            *(f"repro.filters.{name}" for name in point_filters(wildcards)),
            f"repro.studies.{wildcards.study}",
        ),
    script:
        "../scripts/view.py"


rule archive:
    input:
        manifest=LAYOUT.page("manifest.json"),
    output:
        LAYOUT.page("archive.zip"),
    log:
        LAYOUT.job_log("archive"),
    conda:
        ENVIRONMENT
    params:
        code=code("repro.provenance.archive"),
    script:
        "../scripts/archive.py"


rule user_log:
    input:
        log=lambda wildcards: asked_for("log"),
    output:
        LAYOUT.user_estimates(),
    log:
        LAYOUT.job_log("user_log", "{filter}"),
    wildcard_constraints:
        filter="[a-z0-9_]+",
    conda:
        ENVIRONMENT
    params:
        user_log=lambda wildcards: {
            "study": asked_for("study"),
            "point": asked_for("point"),
            "parameters": user_log_point().parameters.plain(),
            "changes": or_exit(user_values, RUN.parameters),
            "seed": RUN.root_seed,
            "settings": REGISTRY.settings(
                wildcards.filter, asked_for("study"), asked_for("point")
            ),
        },
        code=lambda wildcards: or_exit(
            code_digest,
            "repro.inspect.user_log",
            f"repro.filters.{wildcards.filter}",
            f"repro.studies.{asked_for('study')}",
        ),
    script:
        "../scripts/user_log.py"


rule catalogue:
    output:
        LAYOUT.page("catalogue.json"),
    log:
        LAYOUT.job_log("catalogue"),
    conda:
        ENVIRONMENT
    params:
        filters=REGISTRY.catalogue(*STUDIES, requested=True),
        settings=REGISTRY.all_settings(*STUDIES),
        code=code("repro.workflow.registry"),
    script:
        "../scripts/catalogue.py"
