# Stops 4 to 8 of the data: tables, diff, figures, manifest, report.
rule table:
    input:
        runs=lambda wildcards: run_files(wildcards.study),
        code=code("repro.tables"),
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
    script:
        "../scripts/table.py"


rule packet_example:
    input:
        code=code("repro.tables"),
    output:
        f"{RESULTS}/tables/packet_example.csv",
    log:
        f"{RESULTS}/job_logs/packet_example.log",
    conda:
        ENVIRONMENT
    params:
        example=PAPERS["packet_delays"].examples["table_1"],
    script:
        "../scripts/packet_example.py"


rule sensitivity:
    input:
        runs=lambda wildcards: sensitivity_runs(wildcards.study),
        code=code("repro.sensitivity"),
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
    script:
        "../scripts/sensitivity.py"


rule complexity:
    input:
        code=code("repro.tables", "repro.textbook"),
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
        code=code("repro.claims.{paper}"),
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
    script:
        "../scripts/claims.py"


rule diff:
    input:
        published=[f"params/published/{paper}.csv" for paper in PAPERS],
        claims=[f"{RESULTS}/claims/{paper}.csv" for paper in PAPERS],
        tables=[file for paper in PAPERS for file in table_files(paper)],
        code=code("repro.published"),
    output:
        csv=report(
            f"{RESULTS}/diff.csv",
            category="Verdicts",
            labels={"table": "published against reproduced"},
            caption="../report/diff.rst",
        ),
        markdown=f"{RESULTS}/diff.md",
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
    script:
        "../scripts/diff.py"


rule figure:
    input:
        figure_inputs,
        script="figures/{paper}/{figure}.py",
        code=code("repro.plot.draw", "figures/{paper}/{figure}.py"),
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
    script:
        "../scripts/figure.py"


rule parameters:
    input:
        files=PARAMETER_FILES,
        code=code("repro.params", "repro.tables"),
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
    script:
        "../scripts/parameters.py"


rule assumptions:
    input:
        files=PARAMETER_FILES,
        published=[f"params/published/{paper}.csv" for paper in PAPERS],
        tables=expand(f"{RESULTS}/tables/{{study}}.csv", study=STUDIES),
        code=code("repro.assumptions"),
    output:
        f"{RESULTS}/assumptions.md",
    log:
        f"{RESULTS}/job_logs/assumptions.log",
    conda:
        ENVIRONMENT
    params:
        papers={
            paper: {
                "parameters": f"params/{paper}.yaml",
                "published": f"params/published/{paper}.csv",
                "studies": {
                    study: {name: point._asdict() for name, point in points.items()}
                    for study, points in content.studies.items()
                },
                "tables": {study: f"{RESULTS}/tables/{study}.csv" for study in content.studies},
            }
            for paper, content in PAPERS.items()
        },
        tolerance=RUN["tolerance"],
    script:
        "../scripts/assumptions.py"


rule gallery:
    input:
        scripts=sorted(str(path) for path in Path("figures").glob("*/*.py")),
        code=code("repro.gallery"),
    output:
        f"{FIGURES}/README.md",
    log:
        f"{RESULTS}/job_logs/gallery.log",
    conda:
        ENVIRONMENT
    params:
        titles={"overview": "All papers."}
        | {paper: f"{content.authors}: {content.title}." for paper, content in PAPERS.items()},
    script:
        "../scripts/gallery.py"


rule manifest:
    input:
        parameters=["params/run.yaml", *PARAMETER_FILES, *rules.diff.input.published],
        tables=[
            rules.diff.output,
            rules.diff.input.claims,
            rules.diff.input.tables,
            rules.parameters.output,
            rules.assumptions.output,
            expand(f"{RESULTS}/curves/{{study}}.csv", study=STUDIES),
        ],
        logs=[file for study in STUDIES for file in log_files(study)],
        figures=[*figure_files(), rules.gallery.output],
        code=code("repro.manifest"),
    output:
        f"{RESULTS}/manifest.json",
    log:
        f"{RESULTS}/job_logs/manifest.log",
    conda:
        ENVIRONMENT
    params:
        commit=commit(),
        seed=RUN["root_seed"],
    script:
        "../scripts/manifest.py"


rule verify:
    input:
        diff=f"{RESULTS}/diff.csv",
        manifest=f"{RESULTS}/manifest.json",
    log:
        f"{RESULTS}/job_logs/verify.log",
    conda:
        ENVIRONMENT
    script:
        "../scripts/verify.py"


rule timings:
    input:
        f"{RESULTS}/manifest.json",
    log:
        f"{RESULTS}/job_logs/timings.log",
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: RESULTS,
    script:
        "../scripts/timings.py"


rule view:
    input:
        logs=lambda wildcards: log_files(wildcards.study, [wildcards.point]),
        runs=lambda wildcards: run_files(wildcards.study, [wildcards.point]),
        code=code("repro.view"),
    output:
        view=f"{RESULTS}/views/{{study}}/{{point}}/trial-{{trial}}.mcap",
        layout=f"{RESULTS}/views/{{study}}/{{point}}/trial-{{trial}}.layout.json",
    log:
        logfile("view", "study", "point", "trial"),
    wildcard_constraints:
        trial="[0-9]+",
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards: RESULTS,
        catalogue=lambda wildcards: catalogue(wildcards.study),
        shards=len(SHARDS),
    script:
        "../scripts/view.py"


rule archive:
    input:
        manifest=f"{RESULTS}/manifest.json",
        code=code("repro.archive"),
    output:
        f"{RESULTS}/archive.zip",
    log:
        f"{RESULTS}/job_logs/archive.log",
    conda:
        ENVIRONMENT
    script:
        "../scripts/archive.py"


rule own:
    input:
        log=lambda wildcards: asked("log"),
        code=lambda wildcards: code_files(
            "repro.own", f"repro.filters.{wildcards.filter}", f"repro.studies.{asked('study')}"
        ),
    output:
        f"{RESULTS}/own/{{filter}}.csv",
    log:
        logfile("own", "filter"),
    wildcard_constraints:
        filter="[a-z0-9_]+",
    conda:
        ENVIRONMENT
    params:
        asked=lambda wildcards: {
            "study": asked("study"),
            "point": asked("point"),
            "parameters": asked_point().parameters,
            "settings": asked_point().filters.get(wildcards.filter, {}),
        },
    script:
        "../scripts/own.py"
