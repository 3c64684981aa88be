from repro.pages.consistency import write_summary
from repro.tables.consistency import tabulate
from repro.tables.results import Results
from repro.workflow.job import job

files = snakemake.output
with job(snakemake.log[0]):
    results = Results(**snakemake.params.results)
    rows = [
        row for study in snakemake.params.studies for row in tabulate(results, study, files[study])
    ]
    write_summary(rows, files.summary)
