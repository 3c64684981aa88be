# What only this paper has: operations of one iteration of each filter, counted (its Table I).
COMPUTED_TABLES["unknown_losses"].append("complexity")


rule complexity:
    output:
        LAYOUT.table("complexity"),
    log:
        LAYOUT.job_log("complexity"),
    conda:
        ENVIRONMENT
    params:
        n=6,
        m=2,
        particles=STUDIES["radar"]["loss=0.5"].filters["rbpf"]["particles"],
        code=code("repro.papers.unknown_losses.operation_counts"),
    script:
        "../../scripts/papers/complexity.py"
