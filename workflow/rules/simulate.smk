# Stop 2 of the data: ground truth and impaired measurements as logs.
rule simulate:
    output:
        log=LOG,
    log:
        logfile("simulate"),
    benchmark:
        timing("simulate")
    conda:
        ENVIRONMENT
    params:
        parameters=lambda wildcards: STUDIES[wildcards.study][wildcards.point].parameters,
        seed=RUN["root_seed"],
        trials=lambda wildcards: trial_range(*wildcards),
        code=code("repro.simulate"),
    script:
        "../scripts/simulate.py"
