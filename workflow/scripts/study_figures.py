from repro.plot import study_figures, style
from repro.tables.results import Results
from repro.workflow.job import job

study = snakemake.wildcards.study
with job(snakemake.log[0]):
    results = Results(**snakemake.params.results)
    for kind, path in snakemake.output.items():
        style.save(getattr(study_figures, kind)(results, study), path)
