from repro.papers.unknown_losses.operation_counts import table_1
from repro.tables.csv_file import write_csv
from repro.workflow.job import job

params = snakemake.params
with job(snakemake.log[0]):
    write_csv(table_1(params.n, params.m, params.particles), snakemake.output[0])
