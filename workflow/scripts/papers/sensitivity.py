from repro.papers.censored_network.sensitivity import tabulate
from repro.tables.results import Results
from repro.workflow.job import job

with job(snakemake.log[0]):
    results = Results(**snakemake.params.results)
    tabulate(results, snakemake.wildcards.study, snakemake.output[0])
