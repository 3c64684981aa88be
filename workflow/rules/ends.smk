# The start and the end of a run: stale results, what it needs, its tally.
import threading

from repro.provenance.records import Records
from repro.workflow.memory_and_disk import check_needs, estimated_needs, free


def check_records():
    """End Snakemake if the results are stale and it has no records to know it by."""
    records = Records(".snakemake", LAYOUT)
    or_exit(
        records.check,
        lambda: {study: origins(study, requested=True) for study in STUDIES},
        RUN.shards,
        source_digest,
    )
    if RUNS_JOBS:
        records.take()


def print_needs():
    """What the run takes of memory and disk, at its start; ends it if less is free."""
    made = [file for job in workflow.dag.needrun_jobs() for file in job.output]
    local = workflow.local_exec
    needed = estimated_needs(made, LAYOUT, STUDIES, RUN.shards, workflow.cores if local else 1)
    if needed.jobs:
        print(or_exit(check_needs, needed, free(LAYOUT.root), LAYOUT.root, local=local))


def stop_timers():
    """End the timers of Snakemake's scheduler, for which its end would wait."""
    for thread in threading.enumerate():
        if isinstance(thread, threading.Timer):
            thread.cancel()


def print_tally():
    """The verdicts at a glance, at the end of a run."""
    if SMOKE:
        print(
            "Smoke run: the first point of each family, few trials; no claims, and no figures that "
            "compare points.\nEverything: snakemake -j2"
        )
        return
    tally = Path(LAYOUT.page("tally.txt"))
    if tally.exists():
        print(tally.read_text(encoding="utf-8"), end="")
