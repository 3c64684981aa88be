from repro.tables.results import Results
from repro.verdicts.claims import decide
from repro.verdicts.facts import state
from repro.verdicts.joint import compare_tables
from repro.workflow.job import job

given, made = snakemake.input, snakemake.output
with job(snakemake.log[0]):
    results, paper = Results(**snakemake.params.results), snakemake.wildcards.paper
    decide(results, paper, made.claims)
    state(results, paper, made.facts)
    compare_tables(results, paper, given.published, made.joint)
