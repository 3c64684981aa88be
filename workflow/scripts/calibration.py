from repro.workflow.job import job

with job(snakemake.log[0]):
    print("\n".join(snakemake.input))
