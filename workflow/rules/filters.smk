# Stop 3 of the data, and the catalogue of the filters: one rule a filter. Its runs(...) is all that
# tables, curves, diff and figures need to know of it.


rule omvf:
    input:
        log=LOG,
    output:
        runs("omvf", studies=["linear_delays"]),
    log:
        logfile("omvf"),
    benchmark:
        timing("omvf")
    conda:
        ENVIRONMENT
    params:
        name="omvf",
        settings=settings("omvf"),
        code=code("repro.run", "repro.filters.omvf"),
    script:
        RUN_FILTER


rule nahi:
    input:
        log=LOG,
    output:
        runs("nahi", studies=["linear_delays"]),
    log:
        logfile("nahi"),
    benchmark:
        timing("nahi")
    conda:
        ENVIRONMENT
    params:
        name="nahi",
        settings=settings("nahi"),
        code=code("repro.run", "repro.filters.nahi"),
    script:
        RUN_FILTER


rule intermittent_kf:
    input:
        log=LOG,
    output:
        runs("intermittent_kf", studies=["linear_delays"]),
    log:
        logfile("intermittent_kf"),
    benchmark:
        timing("intermittent_kf")
    conda:
        ENVIRONMENT
    params:
        name="intermittent_kf",
        settings=settings("intermittent_kf"),
        code=code("repro.run", "repro.filters.intermittent_kf"),
    script:
        RUN_FILTER


rule sun:
    input:
        log=LOG,
    output:
        runs("sun", studies=["linear_delays"]),
    log:
        logfile("sun"),
    benchmark:
        timing("sun")
    conda:
        ENVIRONMENT
    params:
        name="sun",
        settings=settings("sun"),
        code=code("repro.run", "repro.filters.sun"),
    script:
        RUN_FILTER


rule genie:
    input:
        log=LOG,
    output:
        runs("genie", studies=["linear_delays"]),
    log:
        logfile("genie"),
    benchmark:
        timing("genie")
    conda:
        ENVIRONMENT
    params:
        name="genie",
        settings=settings("genie"),
        code=code("repro.run", "repro.filters.genie"),
    script:
        RUN_FILTER


rule best_in_form:
    input:
        log=LOG,
    output:
        runs("best_in_form", studies=["linear_delays"]),
    log:
        logfile("best_in_form"),
    benchmark:
        timing("best_in_form")
    conda:
        ENVIRONMENT
    params:
        name="best_in_form",
        settings=settings("best_in_form"),
        code=code("repro.run", "repro.filters.best_in_form"),
    script:
        RUN_FILTER


rule emvf:
    input:
        log=LOG,
    output:
        runs("emvf", studies=["wsn_tracking"]),
    log:
        logfile("emvf"),
    benchmark:
        timing("emvf")
    conda:
        ENVIRONMENT
    params:
        name="emvf",
        settings=settings("emvf"),
        code=code("repro.run", "repro.filters.emvf"),
    script:
        RUN_FILTER


rule ekf:
    input:
        log=LOG,
    output:
        runs(
            "ekf",
            studies=["wsn_tracking", "linear_losses", "radar"],
            skip=["particles=*", "bkf_2-*", "rbpf-*"],
        ),
    log:
        logfile("ekf"),
    benchmark:
        timing("ekf")
    conda:
        ENVIRONMENT
    params:
        name="ekf",
        settings=settings("ekf"),
        code=code("repro.run", "repro.filters.ekf"),
    script:
        RUN_FILTER


rule iekf:
    input:
        log=LOG,
    output:
        runs(
            "iekf",
            studies=["wsn_tracking", "linear_losses", "radar"],
            skip=["particles=*", "bkf_2-*", "rbpf-*"],
        ),
    log:
        logfile("iekf"),
    benchmark:
        timing("iekf")
    conda:
        ENVIRONMENT
    params:
        name="iekf",
        settings=settings("iekf"),
        code=code("repro.run", "repro.filters.iekf"),
    script:
        RUN_FILTER


rule emvf_realised:
    input:
        log=LOG,
    output:
        runs(
            "emvf_realised",
            studies=["wsn_tracking"],
            points=["n2-arrival=0.9", "reading-indicator_of=*"],
        ),
    log:
        logfile("emvf_realised"),
    benchmark:
        timing("emvf_realised")
    conda:
        ENVIRONMENT
    params:
        name="emvf_realised",
        settings=settings("emvf_realised"),
        code=code("repro.run", "repro.filters.emvf_realised"),
    script:
        RUN_FILTER


rule mapf:
    input:
        log=LOG,
    output:
        runs("mapf", studies=["deadband", "saturation"]),
    log:
        logfile("mapf"),
    benchmark:
        timing("mapf")
    conda:
        ENVIRONMENT
    params:
        name="mapf",
        settings=settings("mapf"),
        code=code("repro.run", "repro.filters.mapf"),
    script:
        RUN_FILTER


rule mapf_nc:
    input:
        log=LOG,
    output:
        runs("mapf_nc", studies=["deadband", "saturation"]),
    log:
        logfile("mapf_nc"),
    benchmark:
        timing("mapf_nc")
    conda:
        ENVIRONMENT
    params:
        name="mapf_nc",
        settings=settings("mapf_nc"),
        code=code("repro.run", "repro.filters.mapf_nc"),
    script:
        RUN_FILTER


rule mapf_nmc:
    input:
        log=LOG,
    output:
        runs("mapf_nmc", studies=["deadband", "saturation"]),
    log:
        logfile("mapf_nmc"),
    benchmark:
        timing("mapf_nmc")
    conda:
        ENVIRONMENT
    params:
        name="mapf_nmc",
        settings=settings("mapf_nmc"),
        code=code("repro.run", "repro.filters.mapf_nmc"),
    script:
        RUN_FILTER


rule mpf:
    input:
        log=LOG,
    output:
        runs("mpf", studies=["deadband", "saturation"]),
    log:
        logfile("mpf"),
    benchmark:
        timing("mpf")
    conda:
        ENVIRONMENT
    params:
        name="mpf",
        settings=settings("mpf"),
        code=code("repro.run", "repro.filters.mpf"),
    script:
        RUN_FILTER


rule dead_reckoning:
    input:
        log=LOG,
    output:
        runs("dead_reckoning", studies=["deadband", "saturation"]),
    log:
        logfile("dead_reckoning"),
    benchmark:
        timing("dead_reckoning")
    conda:
        ENVIRONMENT
    params:
        name="dead_reckoning",
        settings=settings("dead_reckoning"),
        code=code("repro.run", "repro.filters.dead_reckoning"),
    script:
        RUN_FILTER


rule pf_ross_eh:
    input:
        log=LOG,
    output:
        runs("pf_ross_eh", studies=["ungm", "rss_2d", "rss_3d"]),
    log:
        logfile("pf_ross_eh"),
    benchmark:
        timing("pf_ross_eh")
    conda:
        ENVIRONMENT
    params:
        name="pf_ross_eh",
        settings=settings("pf_ross_eh"),
        code=code("repro.run", "repro.filters.pf_ross_eh"),
    script:
        RUN_FILTER


rule pf_ross:
    input:
        log=LOG,
    output:
        runs(
            "pf_ross",
            studies=["ungm", "rss_2d", "rss_3d"],
            points=["base", "reading-layout=*", "reading-weights=*"],
        ),
    log:
        logfile("pf_ross"),
    benchmark:
        timing("pf_ross")
    conda:
        ENVIRONMENT
    params:
        name="pf_ross",
        settings=settings("pf_ross"),
        code=code("repro.run", "repro.filters.pf_ross"),
    script:
        RUN_FILTER


rule pf_eh:
    input:
        log=LOG,
    output:
        runs(
            "pf_eh",
            studies=["ungm", "rss_2d", "rss_3d"],
            points=["base", "reading-layout=*", "reading-weights=*"],
        ),
    log:
        logfile("pf_eh"),
    benchmark:
        timing("pf_eh")
    conda:
        ENVIRONMENT
    params:
        name="pf_eh",
        settings=settings("pf_eh"),
        code=code("repro.run", "repro.filters.pf_eh"),
    script:
        RUN_FILTER


rule spf:
    input:
        log=LOG,
    output:
        runs(
            "spf",
            studies=["ungm", "rss_2d", "rss_3d"],
            points=["base", "reading-layout=*", "reading-weights=*"],
        ),
    log:
        logfile("spf"),
    benchmark:
        timing("spf")
    conda:
        ENVIRONMENT
    params:
        name="spf",
        settings=settings("spf"),
        code=code("repro.run", "repro.filters.spf"),
    script:
        RUN_FILTER


rule spf_im:
    input:
        log=LOG,
    output:
        runs(
            "spf_im",
            studies=["ungm", "rss_2d", "rss_3d"],
            points=["base", "reading-layout=*", "reading-weights=*"],
        ),
    log:
        logfile("spf_im"),
    benchmark:
        timing("spf_im")
    conda:
        ENVIRONMENT
    params:
        name="spf_im",
        settings=settings("spf_im"),
        code=code("repro.run", "repro.filters.spf_im"),
    script:
        RUN_FILTER


rule pf_ross_eh_exact:
    input:
        log=LOG,
    output:
        runs(
            "pf_ross_eh_exact",
            studies=["ungm"],
            points=["base", "reading-harvest=*"],
        ),
    log:
        logfile("pf_ross_eh_exact"),
    benchmark:
        timing("pf_ross_eh_exact")
    conda:
        ENVIRONMENT
    params:
        name="pf_ross_eh_exact",
        settings=settings("pf_ross_eh_exact"),
        code=code("repro.run", "repro.filters.pf_ross_eh_exact"),
    script:
        RUN_FILTER


rule pf_ross_eh_joint:
    input:
        log=LOG,
    output:
        runs(
            "pf_ross_eh_joint",
            studies=["ungm"],
            points=["base", "reading-harvest=*"],
        ),
    log:
        logfile("pf_ross_eh_joint"),
    benchmark:
        timing("pf_ross_eh_joint")
    conda:
        ENVIRONMENT
    params:
        name="pf_ross_eh_joint",
        settings=settings("pf_ross_eh_joint"),
        code=code("repro.run", "repro.filters.pf_ross_eh_joint"),
    script:
        RUN_FILTER


rule bkf_1:
    input:
        log=LOG,
    output:
        runs(
            "bkf_1",
            studies=["linear_losses", "radar"],
            skip=["particles=*", "bkf_2-*", "rbpf-*"],
        ),
    log:
        logfile("bkf_1"),
    benchmark:
        timing("bkf_1")
    conda:
        ENVIRONMENT
    params:
        name="bkf_1",
        settings=settings("bkf_1"),
        code=code("repro.run", "repro.filters.bkf_1"),
    script:
        RUN_FILTER


rule bkf_2:
    input:
        log=LOG,
    output:
        runs(
            "bkf_2",
            studies=["linear_losses", "radar"],
            skip=["particles=*", "rbpf-*"],
        ),
    log:
        logfile("bkf_2"),
    benchmark:
        timing("bkf_2")
    conda:
        ENVIRONMENT
    params:
        name="bkf_2",
        settings=settings("bkf_2"),
        code=code("repro.run", "repro.filters.bkf_2"),
    script:
        RUN_FILTER


rule rbpf:
    input:
        log=LOG,
    output:
        runs("rbpf", studies=["linear_losses", "radar"], skip=["bkf_2-*", "pooled-*"]),
    log:
        logfile("rbpf"),
    benchmark:
        timing("rbpf")
    conda:
        ENVIRONMENT
    params:
        name="rbpf",
        settings=settings("rbpf"),
        code=code("repro.run", "repro.filters.rbpf"),
    script:
        RUN_FILTER


rule rbpf_fast:
    input:
        log=LOG,
    output:
        runs(
            "rbpf_fast",
            studies=["linear_losses", "radar"],
            points=["loss=0.5", "markov-*", "particles=*", "pooled-*", "short-*"],
        ),
    log:
        logfile("rbpf_fast"),
    benchmark:
        timing("rbpf_fast")
    conda:
        ENVIRONMENT
    params:
        name="rbpf_fast",
        settings=settings("rbpf_fast"),
        code=code("repro.run", "repro.filters.rbpf_fast"),
    script:
        RUN_FILTER


rule exact:
    input:
        log=LOG,
    output:
        runs(
            "exact",
            studies=["linear_losses"],
            points=["short-*"],
        ),
    log:
        logfile("exact"),
    benchmark:
        timing("exact")
    conda:
        ENVIRONMENT
    params:
        name="exact",
        settings=settings("exact"),
        code=code("repro.run", "repro.filters.exact"),
    script:
        RUN_FILTER


# In a closed loop a filter flies: its rule writes the log of the flight beside the runs.


rule true_state:
    input:
        log=LOG,
    output:
        runs("true_state", studies=["quadrotor"]),
        flight=flights("true_state", studies=["quadrotor"]),
    log:
        logfile("true_state"),
    benchmark:
        timing("true_state")
    conda:
        ENVIRONMENT
    params:
        name="true_state",
        settings=settings("true_state"),
        code=code("repro.run", "repro.filters.true_state"),
    script:
        RUN_FILTER


rule ekf_no_loss:
    input:
        log=LOG,
    output:
        runs("ekf_no_loss", studies=["quadrotor"]),
        flight=flights("ekf_no_loss", studies=["quadrotor"]),
    log:
        logfile("ekf_no_loss"),
    benchmark:
        timing("ekf_no_loss")
    conda:
        ENVIRONMENT
    params:
        name="ekf_no_loss",
        settings=settings("ekf_no_loss"),
        code=code("repro.run", "repro.filters.ekf_no_loss"),
    script:
        RUN_FILTER


use rule iekf as fly_iekf with:
    output:
        runs("iekf", studies=["quadrotor"]),
        flight=flights("iekf", studies=["quadrotor"]),


use rule bkf_1 as fly_bkf_1 with:
    output:
        runs("bkf_1", studies=["quadrotor"]),
        flight=flights("bkf_1", studies=["quadrotor"]),


use rule bkf_2 as fly_bkf_2 with:
    output:
        runs("bkf_2", studies=["quadrotor"]),
        flight=flights("bkf_2", studies=["quadrotor"]),


# Algorithm 4, whose results are Algorithm 3's to the last bit (tests/oracle) in an eighth of its time.
use rule rbpf_fast as fly_rbpf with:
    output:
        runs("rbpf", studies=["quadrotor"]),
        flight=flights("rbpf", studies=["quadrotor"]),
    params:
        name="rbpf_fast",
        settings=settings("rbpf"),
        code=code("repro.run", "repro.filters.rbpf_fast"),


use rule ekf as fly_ekf with:
    output:
        runs("ekf", studies=["quadrotor"]),
        flight=flights("ekf", studies=["quadrotor"]),
