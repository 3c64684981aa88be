from repro.papers.unknown_losses.operation_counts import table_1
from repro.studies import radar
from repro.tables.csv_file import write_csv
from repro.workflow.job import job

params = snakemake.params
with job(snakemake.log[0]):
    parameters = radar.Parameters.checked(params.parameters, "radar: parameters")
    model = radar.STUDY.model(parameters)
    sizes = len(model.initial_mean), len(model.measurement_covariance)
    write_csv(table_1(*sizes, params.particles), snakemake.output[0])
