from repro.papers.censored_network.calibration import Network, Printed
from repro.papers.censored_network.calibration_tables import tabulate_profile
from repro.workflow.job import job

with job(snakemake.log[0]):
    network = Network(**snakemake.params.network)
    tabulate_profile(network, Printed.read(snakemake.input.published), snakemake.output[0])
