from repro.job import job
from repro.results import Results
from repro.tables import tabulate

said, made = snakemake.params, snakemake.output
results = Results(said.results, said.catalogue, said.shards)
job(
    snakemake.log[0],
    lambda: tabulate(results, snakemake.wildcards.study, made.table, made.curves),
)
