from repro.job import job
from repro.timings import timings

job(snakemake.log[0], lambda: print(timings(snakemake.params.results).round(2).to_string()))
