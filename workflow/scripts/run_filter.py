from repro.job import job
from repro.run import run_filter

at, said, written = snakemake.wildcards, snakemake.params, snakemake.output
where = written[0], written.get("flight")
job(
    snakemake.log[0],
    lambda: run_filter(snakemake.input.log, at.study, at.point, said.name, said.settings, *where),
)
