from repro.job import job
from repro.published import verify

job(snakemake.log[0], lambda: verify(snakemake.input[0]))
print("every verdict is as expected")
