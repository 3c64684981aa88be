from repro.tables.results import Results
from repro.verdicts.claims import decide
from repro.verdicts.facts import state
from repro.workflow.job import job

with job(snakemake.log[0]):
    results, paper = Results(**snakemake.params.results), snakemake.wildcards.paper
    decide(results, paper, snakemake.output.claims)
    state(results, paper, snakemake.output.facts)
