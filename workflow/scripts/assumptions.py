from repro.assumptions import write_assumptions
from repro.job import job

said = snakemake.params
job(
    snakemake.log[0],
    lambda: write_assumptions(said.papers, said.tolerance, snakemake.output[0]),
)
