# Stop 2 of the data: ground truth and impaired measurements as logs.
rule simulate:
    input:
        code=code("repro.simulate"),
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
    script:
        "../scripts/simulate.py"
