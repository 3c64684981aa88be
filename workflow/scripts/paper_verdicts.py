from repro.pages.paper_verdicts import write_paper_verdicts
from repro.workflow.job import job

with job(snakemake.log[0]):
    write_paper_verdicts(
        snakemake.wildcards.paper,
        snakemake.params.title,
        snakemake.input.diff,
        snakemake.input.joint,
        snakemake.input.scripts,
        snakemake.input.findings,
        snakemake.input.consistency or None,
        snakemake.output[0],
    )
