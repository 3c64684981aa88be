from repro.tables.results import Results
from repro.verdicts.claims import decide
from repro.workflow.job import job

with job(snakemake.log[0]):
    results = Results(**snakemake.params.results)
    decide(results, snakemake.wildcards.paper, snakemake.output[0])
