from repro.archive import write_archive
from repro.job import job

manifest, made = snakemake.input.manifest, snakemake.output[0]
job(snakemake.log[0], lambda: write_archive(manifest, "MIT", made))
