from repro.plot.draw import draw
from repro.tables.results import Results
from repro.workflow.job import job

given = snakemake.params
with job(snakemake.log[0]):
    results = Results(**given.results)
    pictures = given.get("pictures") or snakemake.output
    for script, picture in zip(snakemake.input.scripts, pictures, strict=True):
        draw(script, results, picture)
