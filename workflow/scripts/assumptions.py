from repro.pages.assumptions import write_assumptions
from repro.workflow.job import job

with job(snakemake.log[0]):
    write_assumptions(
        snakemake.params.papers,
        snakemake.params.tolerance,
        snakemake.output[0],
        **snakemake.params.verdicts,
    )
