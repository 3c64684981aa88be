from repro.tables.results import Results
from repro.tables.study_tables import tabulate
from repro.workflow.job import job

files = snakemake.output
with job(snakemake.log[0]):
    results = Results(**snakemake.params.results)
    study = snakemake.wildcards.study
    ranking = files.ranking, files.over_k, files.shares
    tabulate(results, study, files.table, files.curves, ranking)
