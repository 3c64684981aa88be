from repro.origin import of_shard, origin
from repro.simulate import simulate
from repro.workflow.job import job

given, shard = snakemake.params, int(snakemake.wildcards.shard)
with job(snakemake.log[0]):
    for path, (point, of_point) in zip(snakemake.output, given.points.items(), strict=True):
        parameters = of_point["parameters"]
        trials = of_shard(parameters["trials"], shard, given.shards)
        made = origin(of_point["made_with"], trials)
        simulate(given.study, point, parameters, given.seed, trials, path, made)
