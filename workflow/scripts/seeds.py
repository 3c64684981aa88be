from repro.pages.seeds import write_seeds
from repro.workflow.job import job

files, made = snakemake.input, snakemake.output
with job(snakemake.log[0]):
    write_seeds(dict(zip(snakemake.params.seeds, files, strict=True)), made.csv, made.markdown)
print(f"{made.markdown}: how often each verdict holds")
