# Stop 3 of the data, and the catalogue of the filters: one rule a filter. A rule's runs(...) is all that
# tables, curves, diff and figures need to know of it. docs in README.md, "A filter of your own".


rule omvf:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.omvf", "repro.studies.{study}"),
    output:
        runs("omvf", studies=["linear_delays"]),
    params:
        name="omvf",
        settings=settings("omvf"),
    log:
        logfile("omvf"),
    benchmark:
        timing("omvf")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER


rule nahi:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.nahi", "repro.studies.{study}"),
    output:
        runs("nahi", studies=["linear_delays"]),
    params:
        name="nahi",
        settings=settings("nahi"),
    log:
        logfile("nahi"),
    benchmark:
        timing("nahi")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER


rule intermittent_kf:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.intermittent_kf", "repro.studies.{study}"),
    output:
        runs("intermittent_kf", studies=["linear_delays"]),
    params:
        name="intermittent_kf",
        settings=settings("intermittent_kf"),
    log:
        logfile("intermittent_kf"),
    benchmark:
        timing("intermittent_kf")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER


rule sun:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.sun", "repro.studies.{study}"),
    output:
        runs("sun", studies=["linear_delays"]),
    params:
        name="sun",
        settings=settings("sun"),
    log:
        logfile("sun"),
    benchmark:
        timing("sun")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER


rule genie:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.genie", "repro.studies.{study}"),
    output:
        runs("genie", studies=["linear_delays"]),
    params:
        name="genie",
        settings=settings("genie"),
    log:
        logfile("genie"),
    benchmark:
        timing("genie")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER


rule best_in_form:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.best_in_form", "repro.studies.{study}"),
    output:
        runs("best_in_form", studies=["linear_delays"]),
    params:
        name="best_in_form",
        settings=settings("best_in_form"),
    log:
        logfile("best_in_form"),
    benchmark:
        timing("best_in_form")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER


rule emvf:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.emvf", "repro.studies.{study}"),
    output:
        runs("emvf", studies=["wsn_tracking"]),
    params:
        name="emvf",
        settings=settings("emvf"),
    log:
        logfile("emvf"),
    benchmark:
        timing("emvf")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER


rule ekf:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.ekf", "repro.studies.{study}"),
    output:
        runs("ekf", studies=["wsn_tracking"]),
    params:
        name="ekf",
        settings=settings("ekf"),
    log:
        logfile("ekf"),
    benchmark:
        timing("ekf")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER


rule iekf:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.iekf", "repro.studies.{study}"),
    output:
        runs("iekf", studies=["wsn_tracking"]),
    params:
        name="iekf",
        settings=settings("iekf"),
    log:
        logfile("iekf"),
    benchmark:
        timing("iekf")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER


rule emvf_realised:
    input:
        log=LOG,
        code=code("repro.job", "repro.run", "repro.filters.emvf_realised", "repro.studies.{study}"),
    output:
        runs("emvf_realised", studies=["wsn_tracking"], points=["n2-arrival=0.9", "reading-indicator_of=*"]),
    params:
        name="emvf_realised",
        settings=settings("emvf_realised"),
    log:
        logfile("emvf_realised"),
    benchmark:
        timing("emvf_realised")
    conda:
        ENVIRONMENT
    script:
        RUN_FILTER
