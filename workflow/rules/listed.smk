# Filters that a study's parameter file lists under `run`: they need no rule of their own.
for study, names in LISTED.items():

    rule:
        name:
            f"listed_{study}"
        input:
            log=LAYOUT.log(),
        output:
            or_exit(REGISTRY.listed, study, names),
        log:
            LAYOUT.job_log("{filter}", "{study}", "{point}", "{shard}"),
        benchmark:
            LAYOUT.timing("{filter}", "{study}", "{point}", "{shard}")
        group:
            "point"
        conda:
            ENVIRONMENT
        resources:
            mem_mb=1500,
        params:
            settings=settings,
            code=code("repro.runner", "repro.filters.{filter}"),
        script:
            "../scripts/run_filter.py"
