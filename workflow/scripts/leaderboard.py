from repro.pages.leaderboard import write_leaderboard, write_page
from repro.tables.csv_file import write_csv
from repro.workflow.job import job
from repro.workflow.timings import filter_times

files, of_run = snakemake.output, snakemake.params
with job(snakemake.log[0]):
    write_leaderboard(snakemake.input, files.csv)
    times = filter_times(of_run.root, of_run.catalogue, of_run.points, of_run.shards)
    write_csv(times, files.times)
    write_page(files.csv, files.times, files.markdown)
