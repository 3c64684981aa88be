# On request: the static site, from all that a run has left. Read results/site/index.html.
rule site:
    input:
        results=[
            *(LAYOUT.page(f"{name}.csv") for name in ("diff", "robustness", "leaderboard")),
            LAYOUT.page("manifest.json"),
        ],
        texts=sorted(map(str, Path("docs").rglob("*.*"))),
    output:
        LAYOUT.page("site/index.html"),
    log:
        LAYOUT.job_log("site"),
    conda:
        ENVIRONMENT
    params:
        root=lambda wildcards: str(LAYOUT.root),
        catalogue=REGISTRY.catalogue(*STUDIES),
        project=workflow.basedir,
        figures=lambda wildcards: FIGURES,
        source=source_digest(),  # its pages show the code
    script:
        "../scripts/site.py"
