from repro.provenance.archive import write_archive
from repro.workflow.job import job

with job(snakemake.log[0]):
    write_archive(snakemake.input.manifest, "MIT", snakemake.output[0])
