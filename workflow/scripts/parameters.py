from repro.parameters.load import sources
from repro.tables.csv_file import write_csv
from repro.workflow.job import job

with job(snakemake.log[0]):
    write_csv([row for file in snakemake.input.files for row in sources(file)], snakemake.output[0])
