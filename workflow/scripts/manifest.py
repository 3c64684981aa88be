from repro.provenance.manifest import write_manifest
from repro.workflow.job import job

files, params = snakemake.input, snakemake.params
with job(snakemake.log[0]):
    results = [*files.tables, *params.logs, *files.figures]
    write_manifest(
        snakemake.output[0], params.commit, params.source, params.seed, files.parameters, results
    )
