from repro.provenance.manifest import check_manifest
from repro.verdicts.published import verify
from repro.workflow.job import job

with job(snakemake.log[0]):
    check_manifest(snakemake.input.manifest)
    verify(snakemake.input.diff)
print("every result is as in the manifest, and every verdict as expected")
