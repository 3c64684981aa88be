from repro.simulate import simulate
from repro.workflow.job import job

at, params = snakemake.wildcards, snakemake.params
with job(snakemake.log[0]):
    simulate(
        at.study, at.point, params.parameters, params.seed, params.trials, snakemake.output.log
    )
