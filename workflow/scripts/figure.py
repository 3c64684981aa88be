from repro.job import job
from repro.plot.draw import draw
from repro.results import Results

said = snakemake.params
results = Results(said.results, said.catalogue, said.shards)
job(snakemake.log[0], lambda: draw(snakemake.input.script, results, snakemake.output[0]))
