# Stops 4 to 6 of the data: tables, claims, diff, figures.
rule table:
    input:
        runs=lambda wildcards: run_files(wildcards.study),
    output:
        table=report(
            f"{RESULTS}/tables/{{study}}.csv",
            category="Tables",
            labels={"table": "{study}"},
            caption="../report/table.rst",
        ),
        curves=f"{RESULTS}/curves/{{study}}.csv",
    log:
        logfile("table", "study"),
    benchmark:
        timing("table", "study")
    wildcard_constraints:
        study="|".join(STUDIES),
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: RESULTS,
        catalogue=lambda wildcards: catalogue(wildcards.study),
        shards=len(SHARDS),
        code=code("repro.tables"),
    script:
        "../scripts/table.py"


rule packet_example:
    output:
        f"{RESULTS}/tables/packet_example.csv",
    log:
        f"{RESULTS}/job_logs/packet_example.log",
    conda:
        ENVIRONMENT
    params:
        example=PAPERS["packet_delays"].examples["table_1"],
        code=code("repro.tables"),
    script:
        "../scripts/packet_example.py"


rule sensitivity:
    input:
        runs=lambda wildcards: sensitivity_runs(wildcards.study),
    output:
        f"{RESULTS}/tables/{{study}}_sensitivity.csv",
    log:
        logfile("sensitivity", "study"),
    benchmark:
        timing("sensitivity", "study")
    wildcard_constraints:
        study="|".join(PAPERS["censored_network"].studies),
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: RESULTS,
        catalogue=lambda wildcards: {
            wildcards.study: {**CATALOGUE[wildcards.study], **REQUESTED[wildcards.study]}
        },
        shards=len(SHARDS),
        prefix=ON_REQUEST,
        tolerance=RUN["tolerance"],
        code=code("repro.sensitivity"),
    script:
        "../scripts/sensitivity.py"


rule complexity:
    output:
        f"{RESULTS}/tables/complexity.csv",
    log:
        f"{RESULTS}/job_logs/complexity.log",
    conda:
        ENVIRONMENT
    params:
        n=6,
        m=2,
        particles=STUDIES["radar"]["loss=0.5"].filters["rbpf"]["particles"],
        code=code("repro.tables", "repro.textbook"),
    script:
        "../scripts/complexity.py"


rule claims:
    input:
        runs=lambda wildcards: [
            file for study in PAPERS[wildcards.paper].studies for file in run_files(study)
        ],
        logs=lambda wildcards: [
            file for study in PAPERS[wildcards.paper].studies for file in log_files(study)
        ],
        measured=lambda wildcards: measured_files(wildcards.paper),
    output:
        f"{RESULTS}/claims/{{paper}}.csv",
    log:
        logfile("claims", "paper"),
    benchmark:
        timing("claims", "paper")
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: RESULTS,
        catalogue=lambda wildcards: catalogue(*PAPERS[wildcards.paper].studies),
        shards=len(SHARDS),
        tolerance=RUN["tolerance"],
        code=code("repro.claims.{paper}"),
    script:
        "../scripts/claims.py"


rule diff:
    input:
        published=[f"params/published/{paper}.csv" for paper in PAPERS],
        claims=[f"{RESULTS}/claims/{paper}.csv" for paper in PAPERS],
        tables=[file for paper in PAPERS for file in table_files(paper)],
    output:
        csv=report(
            f"{RESULTS}/diff.csv",
            category="Verdicts",
            labels={"table": "published against reproduced"},
            caption="../report/diff.rst",
        ),
        markdown=f"{RESULTS}/diff.md",
        report=f"{RESULTS}/diff.rst",
        tally=f"{RESULTS}/tally.txt",
    log:
        f"{RESULTS}/job_logs/diff.log",
    benchmark:
        f"{RESULTS}/timings/diff.tsv"
    conda:
        ENVIRONMENT
    params:
        papers={
            paper: {
                "published": f"params/published/{paper}.csv",
                "claims": f"{RESULTS}/claims/{paper}.csv",
                "tables": table_files(paper),
            }
            for paper in PAPERS
        },
        tolerance=RUN["tolerance"],
        code=code("repro.published"),
    script:
        "../scripts/diff.py"


rule figure:
    input:
        figure_inputs,
        script="figures/{paper}/{figure}.py",
    output:
        report(
            f"{FIGURES}/{{paper}}/{{figure}}.png",
            category="Figures",
            subcategory="{paper}",
            labels={"figure": "{figure}"},
            caption="../report/figure.rst",
        ),
    log:
        logfile("figure", "paper", "figure"),
    benchmark:
        timing("figure", "paper", "figure")
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: RESULTS,
        catalogue=lambda wildcards: catalogue(*studies_of(wildcards.paper)),
        shards=len(SHARDS),
        caption=lambda wildcards: constants(f"figures/{wildcards.paper}/{wildcards.figure}.py")[
            "CAPTION"
        ],
        code=code("repro.plot.draw", "figures/{paper}/{figure}.py"),
    script:
        "../scripts/figure.py"


rule parameters:
    input:
        files=PARAMETER_FILES,
    output:
        report(
            f"{RESULTS}/parameters.csv",
            category="Verdicts",
            labels={"table": "parameters, stated and assumed"},
            caption="../report/parameters.rst",
        ),
    log:
        f"{RESULTS}/job_logs/parameters.log",
    conda:
        ENVIRONMENT
    params:
        code=code("repro.params", "repro.tables"),
    script:
        "../scripts/parameters.py"
