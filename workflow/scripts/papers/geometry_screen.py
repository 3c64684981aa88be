from repro.papers.censored_network.calibration import Network, Printed
from repro.papers.censored_network.calibration_search import screen
from repro.workflow.job import job

with job(snakemake.log[0]):
    network = Network(**snakemake.params.network)
    screen(network, Printed.read(snakemake.input.published), snakemake.output[0])
