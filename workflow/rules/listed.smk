# Filters that a study's parameter file lists under `run`: they need no rule of their own.
for study, names in LISTED.items():

    rule:
        name:
            f"listed_{study}"
        input:
            logs=filtered_logs,
        output:
            or_exit(REGISTRY.listed, study, names),
        log:
            LAYOUT.job_log("{filter}", "{study}", "{batch}", "{shard}"),
        benchmark:
            LAYOUT.timing("{filter}", "{study}", "{batch}", "{shard}")
        conda:
            ENVIRONMENT
        resources:
            mem_mb=1500,
        params:
            points=filtered_points,
            made_with=filtered_with,
            code=code("repro.runner", "repro.filters.{filter}"),
        script:
            "../scripts/run_filter.py"
