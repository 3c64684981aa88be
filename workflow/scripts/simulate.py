from repro.job import job
from repro.simulate import simulate

at, said = snakemake.wildcards, snakemake.params
job(
    snakemake.log[0],
    lambda: simulate(
        at.study, at.point, said.parameters, said.seed, said.trials, snakemake.output.log
    ),
)
