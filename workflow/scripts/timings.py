from repro.workflow.job import job
from repro.workflow.timings import timings

with job(snakemake.log[0]):
    print(timings(snakemake.params.results).round(2).to_string())
