# Four papers on filtering over unreliable networks, rebuilt from parameters to verdicts.
from snakemake.utils import min_version

min_version("9.18")


include: "workflow/rules/common.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/filters.smk"
include: "workflow/rules/results.smk"
include: "workflow/rules/pages.smk"


# On a cluster, where a run was started: they take about a second, and verify and timings print.
localrules:
    all,
    archive,
    assumptions,
    complexity,
    diff,
    gallery,
    manifest,
    packet_example,
    parameters,
    timings,
    verify,


report: Path(RESULTS, "diff.rst").absolute()


rule all:
    default_target: True
    input:
        f"{RESULTS}/manifest.json",


onsuccess:
    print_tally()
