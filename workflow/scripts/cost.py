from repro.plot import style
from repro.plot.cost import cost
from repro.tables.cost import write_cost
from repro.tables.results import Results
from repro.workflow.job import job
from repro.workflow.timings import filter_times

files, given = snakemake.output, snakemake.params
with job(snakemake.log[0]):
    results = Results(**given.results)
    times = filter_times(given.results["root"], results.catalogue, given.sizes, len(results.shards))
    for study, ranking, table, picture in zip(
        given.studies, snakemake.input.rankings, files.tables, files.pictures, strict=True
    ):
        write_cost(times, ranking, given.studies[study], table)
        style.save(cost(results, study, table), picture)
