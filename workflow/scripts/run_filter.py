from repro.runner import in_shard, run_filter
from repro.workflow.job import job

at = snakemake.wildcards
with job(snakemake.log[0]) as usage:
    points = in_shard(at.study, int(at.shard), **snakemake.params.points)
    usage.of_points = run_filter(at.study, at.filter, points, snakemake.output[0])
