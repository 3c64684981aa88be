from repro.tables.mismatch import write_mismatch
from repro.tables.results import Results
from repro.workflow.job import job

given = snakemake.params
with job(snakemake.log[0]):
    results = Results(**given.results)
    for study, path in zip(given.studies, snakemake.output, strict=True):
        write_mismatch(results, study, path)
