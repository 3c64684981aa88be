from repro.runner import FilteredPoint, run_filter
from repro.workflow.job import job

at, given = snakemake.wildcards, snakemake.params.points
with job(snakemake.log[0]) as usage:
    points = {name: FilteredPoint(**point) for name, point in given.items()}
    usage.of_points = run_filter(at.study, at.filter, points, snakemake.output[0])
