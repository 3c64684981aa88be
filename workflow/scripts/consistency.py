from repro.pages.consistency import write_summary
from repro.tables import bounds, consistency
from repro.tables.results import Results
from repro.workflow.job import job

files = snakemake.output
with job(snakemake.log[0]):
    results = Results(**snakemake.params.results)
    claims, least = [], []
    of_studies = zip(snakemake.params.studies, files.consistency, files.bounds, strict=True)
    for study, of_claims, of_bounds in of_studies:
        claims += consistency.tabulate(results, study, of_claims)
        papers = results.ranking(study).papers
        compared = bounds.tabulate(results, study, of_bounds)
        least += [row for row in compared if row["filter"] in papers]
    write_summary(claims, least, files.summary)
