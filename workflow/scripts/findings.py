from repro.pages.findings import write_findings
from repro.tables.results import Results
from repro.verdicts.decidable import write_decidable
from repro.workflow.job import job

files, given = snakemake.output, snakemake.params
with job(snakemake.log[0]):
    results = Results(**given.results)
    write_decidable(snakemake.input.claims, given.printed, results.tolerance, files.decidable)
    write_findings(results, given.papers, files.decidable, files.findings)
