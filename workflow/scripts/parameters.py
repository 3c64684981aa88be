from repro.job import job
from repro.params import sources
from repro.tables import write_csv

files, made = snakemake.input.files, snakemake.output[0]
job(snakemake.log[0], lambda: write_csv([row for file in files for row in sources(file)], made))
