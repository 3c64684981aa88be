from repro.job import job
from repro.results import Results
from repro.sensitivity import tabulate

at, said = snakemake.wildcards, snakemake.params
results = Results(said.results, said.catalogue, said.shards)
job(
    snakemake.log[0],
    lambda: tabulate(results, at.study, said.prefix, said.tolerance, snakemake.output[0]),
)
