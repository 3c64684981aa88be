from repro.workflow.job import job
from repro.workflow.registry import write_catalogue

with job(snakemake.log[0]):
    write_catalogue(snakemake.params.filters, snakemake.params.settings, snakemake.output[0])
