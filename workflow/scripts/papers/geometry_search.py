import pandas as pd

from repro.papers.censored_network.calibration import Network, Printed
from repro.papers.censored_network.calibration_search import fit, write_fit
from repro.workflow.job import job

names = snakemake.wildcards
with job(snakemake.log[0]):
    network = Network(**snakemake.params.network)
    printed = Printed.read(snakemake.input.published)
    screened = pd.read_csv(snakemake.input.screened).to_numpy()
    left_out = None if names.left_out == "all" else tuple(names.left_out.split("-"))
    write_fit(fit(network, printed, screened, left_out, int(names.start)), snakemake.output[0])
