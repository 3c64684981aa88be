from repro.pages.leaderboard import write_leaderboard
from repro.workflow.job import job

with job(snakemake.log[0]):
    write_leaderboard(snakemake.params.rankings, snakemake.output.csv, snakemake.output.markdown)
