from repro.inspect.user_log import run_user_log
from repro.workflow.job import job

with job(snakemake.log[0]):
    run_user_log(
        snakemake.input.log,
        snakemake.params.user_log,
        snakemake.wildcards.filter,
        snakemake.output[0],
    )
