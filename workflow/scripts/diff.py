from repro.job import job
from repro.published import diff

said, made = snakemake.params, snakemake.output
job(
    snakemake.log[0],
    lambda: diff(said.papers, said.tolerance, made.csv, made.markdown, made.tally),
)
