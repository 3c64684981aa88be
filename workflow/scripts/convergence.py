from repro.tables.convergence import write_convergence
from repro.tables.results import Results
from repro.workflow.job import job

given = snakemake.params
with job(snakemake.log[0]):
    results = Results(**given.results)
    for (study, printed), path in zip(given.studies.items(), snakemake.output, strict=True):
        write_convergence(results, study, printed, path)
