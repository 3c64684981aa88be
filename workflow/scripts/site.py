from repro.pages.site.build import build_site
from repro.workflow.job import job

given = snakemake.params
with job(snakemake.log[0]):
    build_site(given.root, given.catalogue, given.project, given.figures, snakemake.output[0])
