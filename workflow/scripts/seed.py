from repro.workflow.job import job
from repro.workflow.other_seed import run_seed

given = snakemake.params
with job(snakemake.log[0]):
    config = {"root_seed": snakemake.wildcards.seed, "trials": given.trials}
    run_seed(given.project, config, snakemake.threads, snakemake.output[0])
