from repro.job import job
from repro.results import Results
from repro.view import write_view

at, said, made = snakemake.wildcards, snakemake.params, snakemake.output
results = Results(said.results, said.catalogue, said.shards)
job(
    snakemake.log[0],
    lambda: write_view(results, at.study, at.point, int(at.trial), made.view, made.layout),
)
