from repro.gallery import write_gallery
from repro.job import job

files, made = list(snakemake.input.scripts), snakemake.output[0]
job(snakemake.log[0], lambda: write_gallery(files, snakemake.params.titles, made))
