# What only this paper has: the operations of one iteration of each filter, counted: its Table I.
COMPUTED_TABLES["unknown_losses"].append("complexity")


rule complexity:
    output:
        LAYOUT.table("complexity"),
    log:
        LAYOUT.job_log("complexity"),
    conda:
        ENVIRONMENT
    params:
        # Table I holds for any system; the counts are taken on the radar's, with its particles.
        parameters=STUDIES["radar"]["loss=0.5"].parameters.plain(),
        particles=STUDIES["radar"]["loss=0.5"].filters["rbpf"]["particles"],
        code=code("repro.papers.unknown_losses.operation_counts", "repro.studies.radar"),
    script:
        "../../scripts/papers/complexity.py"
