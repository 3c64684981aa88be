from repro.simulate import simulate
from repro.workflow.job import job

params = snakemake.params
with job(snakemake.log[0]):
    for path, (point, given) in zip(snakemake.output, params.points.items(), strict=True):
        simulate(params.study, point, seed=params.seed, path=path, **given)
