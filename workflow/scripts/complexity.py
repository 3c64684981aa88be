from repro.job import job
from repro.tables import write_csv
from repro.textbook import table_1

said, made = snakemake.params, snakemake.output[0]
job(snakemake.log[0], lambda: write_csv(table_1(said.n, said.m, said.particles), made))
