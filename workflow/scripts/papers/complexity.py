from repro.papers.unknown_losses.operation_counts import table_1
from repro.studies import radar
from repro.tables.csv_file import write_csv
from repro.workflow.job import job

params = snakemake.params
with job(snakemake.log[0]):
    parameters = radar.Parameters.checked(params.parameters, "radar: parameters")
    write_csv(table_1(radar.STUDY.model(parameters), params.particles), snakemake.output[0])
