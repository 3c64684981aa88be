from repro.job import job
from repro.tables import tabulate_packet_example

job(
    snakemake.log[0],
    lambda: tabulate_packet_example("table_1", snakemake.params.example, snakemake.output[0]),
)
