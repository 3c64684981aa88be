from repro.pages.gallery import write_gallery
from repro.workflow.job import job

with job(snakemake.log[0]):
    write_gallery(list(snakemake.input.scripts), snakemake.params.titles, snakemake.output[0])
