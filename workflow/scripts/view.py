from repro.inspect.view import write_view
from repro.tables.results import Results
from repro.workflow.job import job

at, files = snakemake.wildcards, snakemake.output
with job(snakemake.log[0]):
    results = Results(**snakemake.params.results)
    write_view(results, at.study, at.point, int(at.trial), files.view, files.layout)
