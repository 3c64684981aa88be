from repro.tables.results import Results
from repro.verdicts.robustness import judge
from repro.workflow.job import job

given = snakemake.params
with job(snakemake.log[0]):
    results, paper = Results(**given.results), snakemake.wildcards.paper
    judge(results, paper, given.readings, snakemake.input.published, snakemake.output[0])
