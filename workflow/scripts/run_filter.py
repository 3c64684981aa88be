from repro.job import job
from repro.run import run_filter

at, said = snakemake.wildcards, snakemake.params
job(
    snakemake.log[0],
    lambda: run_filter(
        snakemake.input.log, at.study, at.point, said.name, said.settings, snakemake.output[0]
    ),
)
