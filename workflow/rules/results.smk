# Stops 4 to 6 of the data: tables, claims, diff, figures.
# All rules of filters are above: in filters.smk, or in a file that the Snakefile includes before.
or_exit(REGISTRY.read_settings, workflow.rules)
SHEETS = sheets()
if workflow.is_main_process:
    check_records()


rule table:
    input:
        runs=lambda wildcards: REGISTRY.run_files(wildcards.study),
    output:
        table=report(
            LAYOUT.table(),
            category="Tables",
            labels={"table": "{study}"},
            caption="../report/table.rst",
        ),
        curves=LAYOUT.curves(),
        ranking=LAYOUT.ranking(),
        over_k=LAYOUT.error_over_k(),
        shares=LAYOUT.error_shares(),
    log:
        LAYOUT.job_log("table", "{study}"),
    benchmark:
        LAYOUT.timing("table", "{study}")
    wildcard_constraints:
        study="|".join(STUDIES),
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards, output: results_of([wildcards.study]),
        made_with=lambda wildcards: results_with([wildcards.study]),
        code=code("repro.tables.study_tables"),
    script:
        "../scripts/table.py"


rule claims:
    input:
        runs=lambda wildcards: paper_runs(wildcards.paper),
        logs=lambda wildcards: paper_logs(wildcards.paper),
        measured=lambda wildcards: measured_files(wildcards.paper),
        published="params/published/{paper}.csv",
    output:
        claims=LAYOUT.claims(),
        facts=LAYOUT.facts(),
        joint=LAYOUT.joint(),
    log:
        LAYOUT.job_log("claims", "{paper}"),
    benchmark:
        LAYOUT.timing("claims", "{paper}")
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards, output: results_of(PAPERS[wildcards.paper].studies),
        made_with=lambda wildcards: results_with(PAPERS[wildcards.paper].studies),
        code=lambda wildcards: or_exit(
            code_digest,
            "repro.workflow.job",
            "repro.verdicts.facts",
            "repro.verdicts.joint",
            *judged_by(wildcards.paper),
        ),
    script:
        "../scripts/claims.py"


# The verdicts again under every reading of what the paper leaves open.
rule robustness:
    input:
        tables=lambda wildcards: table_files(wildcards.paper),  # made of all runs that it reads
        measured=lambda wildcards: measured_files(wildcards.paper),
        published="params/published/{paper}.csv",
    output:
        LAYOUT.robustness(),
    log:
        LAYOUT.job_log("robustness", "{paper}"),
    benchmark:
        LAYOUT.timing("robustness", "{paper}")
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards, output: results_of(PAPERS[wildcards.paper].studies),
        made_with=lambda wildcards: results_with(PAPERS[wildcards.paper].studies),
        readings=lambda wildcards: {
            study: readings_of(plain_points(study)) for study in PAPERS[wildcards.paper].studies
        },
        code=code("repro.verdicts.robustness", "repro.papers.{paper}.claims"),
    script:
        "../scripts/robustness.py"


rule diff:
    input:
        published=[f"params/published/{paper}.csv" for paper in JUDGED],
        claims=[LAYOUT.claims(paper) for paper in JUDGED],
        facts=[LAYOUT.facts(paper) for paper in JUDGED],
        joint=[LAYOUT.joint(paper) for paper in JUDGED],
        robustness=[LAYOUT.robustness(paper) for paper in JUDGED],
        tables=[file for paper in JUDGED for file in table_files(paper)],
    output:
        csv=report(
            LAYOUT.page("diff.csv"),
            category="Verdicts",
            labels={"table": "published against reproduced"},
            caption="../report/diff.rst",
        ),
        robustness=LAYOUT.page("robustness.csv"),
        html=report(
            LAYOUT.page("diff.html"),
            category="Verdicts",
            labels={"table": "every verdict with its evidence, readings and reason"},
            caption="../report/diff.rst",
        ),
        markdown=LAYOUT.page("diff.md"),
        report=LAYOUT.page("diff.rst"),
        tally=LAYOUT.page("tally.txt"),
    log:
        LAYOUT.job_log("diff"),
    benchmark:
        LAYOUT.timing("diff")
    conda:
        ENVIRONMENT
    params:
        papers={
            paper: {
                "published": f"params/published/{paper}.csv",
                "claims": LAYOUT.claims(paper),
                "facts": LAYOUT.facts(paper),
                "joint": LAYOUT.joint(paper),
                "robustness": LAYOUT.robustness(paper),
                "tables": table_files(paper),
            }
            for paper in JUDGED
        },
        tolerance=RUN.tolerance,
        code=code("repro.pages.verdicts"),
    script:
        "../scripts/diff.py"


# Several figures in one job, as most of the time of a single one would be imports.
for drawn, names in SHEETS.items():

    rule:
        name:
            f"figures_{drawn}"
        input:
            figure_inputs(names),
            scripts=[figure_script(name) for name in names],
        output:
            [
                report(
                    f"{FIGURES}/{name}.png",
                    category="Figures",
                    subcategory=Path(name).parent.name,
                    labels={"figure": Path(name).name, "caption": caption(name)},
                )
                for name in names
            ],
        log:
            LAYOUT.job_log("figures", drawn),
        benchmark:
            LAYOUT.timing("figures", drawn)
        conda:
            ENVIRONMENT
        params:
            results=lambda wildcards, output, names=names: results_of(studies_read(names)),
            made_with=lambda wildcards, names=names: results_with(studies_read(names)),
            code=code("repro.plot.draw", *map(figure_script, names)),
        script:
            "../scripts/figures.py"


# One figure, to look at while one works on its script: --config figure=PAPER/FIGURE
rule draw:
    input:
        lambda wildcards: figure_inputs([asked_for("figure")]),
        scripts=lambda wildcards: [figure_script(asked_for("figure"))],
    log:
        LAYOUT.job_log("draw"),
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: results_of(studies_read([asked_for("figure")])),
        pictures=lambda wildcards: [f"{FIGURES}/{asked_for('figure')}.png"],
    script:
        "../scripts/figures.py"


rule parameters:
    input:
        files=PARAMETER_FILES,
    output:
        report(
            LAYOUT.page("parameters.csv"),
            category="Verdicts",
            labels={"table": "parameters, stated and assumed"},
            caption="../report/parameters.rst",
        ),
    log:
        LAYOUT.job_log("parameters"),
    conda:
        ENVIRONMENT
    params:
        code=code("repro.parameters.load", "repro.tables.study_tables"),
    script:
        "../scripts/parameters.py"
