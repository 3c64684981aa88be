from repro.papers.censored_network.sensitivity import tabulate
from repro.tables.results import Results
from repro.workflow.job import job

params = snakemake.params
with job(snakemake.log[0]):
    results = Results(**params.results)
    tabulate(results, snakemake.wildcards.study, params.tolerance, snakemake.output[0])
