from repro.tables.results import Results
from repro.verdicts.claims import decide
from repro.workflow.job import job

params = snakemake.params
with job(snakemake.log[0]):
    results = Results(**params.results)
    decide(results, snakemake.wildcards.paper, params.tolerance, snakemake.output[0])
