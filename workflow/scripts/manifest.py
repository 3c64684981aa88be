from repro.job import job
from repro.manifest import write_manifest

made, said = snakemake.input, snakemake.params
results = [*made.tables, *made.logs, *made.figures]
job(
    snakemake.log[0],
    lambda: write_manifest(snakemake.output[0], said.commit, said.seed, made.parameters, results),
)
