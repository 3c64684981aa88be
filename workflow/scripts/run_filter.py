from repro.runner import run_filter
from repro.workflow.job import job

at, output = snakemake.wildcards, snakemake.output
with job(snakemake.log[0]):
    run_filter(
        snakemake.input.log,
        at.study,
        at.point,
        at.filter,
        snakemake.params.settings,
        output[0],
        output.get("flight"),
    )
