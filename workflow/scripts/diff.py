from repro.pages.verdicts import write_diff
from repro.workflow.job import job

with job(snakemake.log[0]):
    write_diff(
        snakemake.params.papers, snakemake.params.tolerance, **dict(snakemake.output.items())
    )
