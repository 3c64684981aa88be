from repro.papers.censored_network.calibration import Network, Printed
from repro.papers.censored_network.calibration_search import read_fit
from repro.papers.censored_network.calibration_tables import tabulate_geometries, tabulate_left_out
from repro.workflow.job import job

files, params = snakemake.output, snakemake.params
with job(snakemake.log[0]):
    network = Network(**params.network)
    printed = Printed.read(snakemake.input.published)
    fits = [read_fit(path) for path in snakemake.input.fits]
    tabulate_geometries(network, printed, fits, params.tolerance, files.geometry)
    tabulate_left_out(printed, fits, params.tolerance, files.left_out)
