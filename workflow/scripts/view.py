from repro.inspect.view import write_view
from repro.tables.results import Results
from repro.workflow.job import job

at, files = snakemake.wildcards, snakemake.output
with job(snakemake.log[0]):
    log = Results(**snakemake.params.results).log(at.study, at.point)
    write_view(log, snakemake.params.filters, int(at.trial), files.view, files.layout)
