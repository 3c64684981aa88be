# Stops 7 and 8 of the data, and what a reader asks for: pages, manifest, views, logs of one's own, archive.
rule assumptions:
    input:
        files=PARAMETER_FILES,
        published=[f"params/published/{paper}.csv" for paper in PAPERS],
        tables=expand(f"{RESULTS}/tables/{{study}}.csv", study=STUDIES),
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
        code=code("repro.assumptions"),
    script:
        "../scripts/assumptions.py"


rule gallery:
    input:
        scripts=sorted(str(path) for path in Path("figures").glob("*/*.py")),
    output:
        f"{FIGURES}/README.md",
    log:
        f"{RESULTS}/job_logs/gallery.log",
    conda:
        ENVIRONMENT
    params:
        titles={"overview": "All papers."}
        | {paper: f"{content.authors}: {content.title}." for paper, content in PAPERS.items()},
        code=code("repro.gallery"),
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
    output:
        f"{RESULTS}/manifest.json",
    log:
        f"{RESULTS}/job_logs/manifest.log",
    conda:
        ENVIRONMENT
    params:
        commit=commit(),
        seed=RUN["root_seed"],
        code=code("repro.manifest"),
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
        flights=lambda wildcards: flight_files(wildcards.study, wildcards.point),
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
        code=code("repro.view"),
    script:
        "../scripts/view.py"


rule archive:
    input:
        manifest=f"{RESULTS}/manifest.json",
    output:
        f"{RESULTS}/archive.zip",
    log:
        f"{RESULTS}/job_logs/archive.log",
    conda:
        ENVIRONMENT
    params:
        code=code("repro.archive"),
    script:
        "../scripts/archive.py"


rule own:
    input:
        log=lambda wildcards: asked("log"),
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
        code=lambda wildcards: code_digest(
            "repro.own", f"repro.filters.{wildcards.filter}", f"repro.studies.{asked('study')}"
        ),
    script:
        "../scripts/own.py"
