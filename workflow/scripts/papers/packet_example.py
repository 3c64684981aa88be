from repro.papers.packet_delays.packet_example import tabulate
from repro.workflow.job import job

with job(snakemake.log[0]):
    tabulate("table_1", snakemake.params.example, snakemake.output[0])
