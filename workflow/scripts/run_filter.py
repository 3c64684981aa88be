from repro.runner import run_filter
from repro.workflow.job import job

at, points = snakemake.wildcards, snakemake.params.points
with job(snakemake.log[0]) as usage:
    logs = dict(zip(points, snakemake.input.logs, strict=True))
    usage.of_points = run_filter(logs, at.study, at.filter, points, snakemake.output[0])
