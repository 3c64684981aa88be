# Stop 2 of the data: ground truth and impaired measurements as logs.
rule simulate:
    output:
        log=LAYOUT.log(),
    log:
        LAYOUT.job_log("simulate", "{study}", "{point}", "{shard}"),
    benchmark:
        LAYOUT.timing("simulate", "{study}", "{point}", "{shard}")
    group:
        "point"
    conda:
        ENVIRONMENT
    params:
        parameters=lambda wildcards: STUDIES[wildcards.study][wildcards.point].parameters.plain(),
        seed=RUN.root_seed,
        trials=trial_range,
        code=code("repro.simulate"),
    script:
        "../scripts/simulate.py"
