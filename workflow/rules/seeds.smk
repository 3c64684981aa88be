# On request: everything again with other root seeds, and how often each verdict comes out.
# snakemake seeds --config seeds="1 2 3 4 5" (and trials=50 to be quick)
def asked_seeds():
    """The root seeds that --config names."""
    return str(asked_for("seeds")).split()


rule seed:
    output:
        LAYOUT.of_seed(),
    log:
        LAYOUT.job_log("seed", "{seed}"),
    wildcard_constraints:
        seed="[0-9]+",
    conda:
        ENVIRONMENT
    threads: workflow.cores
    params:
        project=workflow.basedir,
        trials=RUN.trials,
        source=source_digest(),
    script:
        "../scripts/seed.py"


rule seeds:
    input:
        lambda wildcards: [LAYOUT.of_seed(seed) for seed in asked_seeds()],
    output:
        csv=LAYOUT.page("seeds.csv"),
        markdown=LAYOUT.page("seeds.md"),
    log:
        LAYOUT.job_log("seeds"),
    conda:
        ENVIRONMENT
    params:
        seeds=lambda wildcards: asked_seeds(),
        code=code("repro.pages.seeds"),
    script:
        "../scripts/seeds.py"
