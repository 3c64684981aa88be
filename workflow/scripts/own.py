from repro.job import job
from repro.own import run_own

said, name = snakemake.params, snakemake.wildcards.filter
job(
    snakemake.log[0],
    lambda: run_own(snakemake.input.log, said.asked, name, snakemake.output[0]),
)
