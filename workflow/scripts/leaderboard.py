from repro.pages.leaderboard import write_leaderboard
from repro.tables.csv_file import write_csv
from repro.workflow.job import job
from repro.workflow.timings import filter_times

files, given = snakemake.output, snakemake.params
with job(snakemake.log[0]):
    times = filter_times(given.root, given.catalogue, given.points, given.shards)
    write_csv(times, files.times)
    write_leaderboard(given.rankings, files.csv, files.markdown, times)
