from repro.job import job
from repro.published import diff

said, made = snakemake.params, dict(snakemake.output.items())
job(snakemake.log[0], lambda: diff(said.papers, said.tolerance, made.pop("csv"), made))
