from repro.job import job
from repro.manifest import check_manifest
from repro.published import verify

job(
    snakemake.log[0],
    lambda: (check_manifest(snakemake.input.manifest), verify(snakemake.input.diff)),
)
print("every result is as in the manifest, and every verdict as expected")
