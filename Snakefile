# Four papers on filtering over unreliable networks, rebuilt from parameters to verdicts.
from snakemake.utils import min_version

min_version("9.18")


include: "workflow/rules/common.smk"
include: "workflow/rules/origins.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/ends.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/filters.smk"
include: "workflow/rules/listed.smk"
include: "workflow/rules/searches.smk"
include: "workflow/rules/papers/packet_delays.smk"
include: "workflow/rules/papers/censored_network.smk"
include: "workflow/rules/papers/unknown_losses.smk"
include: "workflow/rules/consistency.smk"
include: "workflow/rules/results.smk"
include: "workflow/rules/calibration.smk"
include: "workflow/rules/ranking.smk"
include: "workflow/rules/own_points.smk"
include: "workflow/rules/own_tables.smk"
include: "workflow/rules/pages.smk"
include: "workflow/rules/seeds.smk"
include: "workflow/rules/site.smk"


# On a cluster, where a run was started: they take about a second, and verify and timings print.
localrules:
    all,
    archive,
    assumptions,
    calibration,
    catalogue,
    complexity,
    diff,
    gallery,
    leaderboard,
    manifest,
    packet_example,
    paper_verdicts,
    parameters,
    seeds,
    site,
    timings,
    verify,


report: Path(LAYOUT.page("diff.rst")).absolute()


rule all:
    default_target: True
    input:
        LAYOUT.page("manifest.json"),
        LAYOUT.page("leaderboard.md"),
        [] if SMOKE else rules.cost.output,


onstart:
    print_needs()


onsuccess:
    print_tally()
    stop_timers()


onerror:
    stop_timers()
