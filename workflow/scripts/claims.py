from repro.claims import decide
from repro.job import job
from repro.results import Results

said = snakemake.params
results = Results(said.results, said.catalogue, said.shards)
job(
    snakemake.log[0],
    lambda: decide(results, snakemake.wildcards.paper, said.tolerance, snakemake.output[0]),
)
