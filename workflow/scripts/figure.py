from repro.plot.draw import draw
from repro.tables.results import Results
from repro.workflow.job import job

with job(snakemake.log[0]):
    draw(snakemake.input.script, Results(**snakemake.params.results), snakemake.output[0])
