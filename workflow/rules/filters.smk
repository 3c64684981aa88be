# Stop 3 of the data, and the catalogue of the filters. A filter's rule inherits run_filter; its
# runs(...) is all that tables, curves, verdicts and figures need to know of it.
rule run_filter:
    input:
        logs=filtered_logs,
    output:
        LAYOUT.run(filter_="{filter,(?!)}"),  # matches no file: every filter gives its own
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


use rule run_filter as omvf with:
    output:
        runs("omvf", studies=["linear_delays"]),


use rule run_filter as nahi with:
    output:
        runs("nahi", studies=["linear_delays"], skip=["*constant-delay"]),


use rule run_filter as intermittent_kf with:
    output:
        runs("intermittent_kf", studies=["linear_delays"], skip=["*constant-delay"]),


use rule run_filter as sun with:
    output:
        runs("sun", studies=["linear_delays"], skip=["*constant-delay"]),


use rule run_filter as genie with:
    output:
        runs("genie", studies=["linear_delays"], skip=["reading-*@arrival=*"]),


use rule run_filter as best_in_form with:
    output:
        runs("best_in_form", studies=["linear_delays"], skip=["*constant-delay", "reading-*@*"]),


use rule run_filter as emvf with:
    output:
        runs("emvf", studies=["wsn_tracking"]),


use rule run_filter as ekf with:
    output:
        runs(
            "ekf",
            studies=["wsn_tracking", "linear_losses", "quadrotor"],
            skip=[
                "particles=*",
                "*@particles=*",
                "pooled-*",
                "reading-*@n0-*",
                "reading-*@n?-arrival=0.8*",
                "reading-loss=*",
            ],
        ),


use rule run_filter as ekf_on_radar with:
    output:
        runs(
            "ekf",
            studies=["radar"],
            points=["loss=*", "poor-*", "markov-*", "reading-*@loss=0.5"],
        ),


use rule run_filter as iekf with:
    output:
        runs(
            "iekf",
            studies=["wsn_tracking", "linear_losses", "radar"],
            skip=["particles=*", "*@particles=*", "reading-*@n[0-9]-*"],
        ),


use rule run_filter as iekf_in_flight with:
    output:
        runs("iekf", studies=["quadrotor"], skip=["reading-*"]),


use rule run_filter as emvf_realised with:
    output:
        runs(
            "emvf_realised",
            studies=["wsn_tracking"],
            points=["n2-arrival=0.9", "reading-indicator_of=*"],
        ),


# Of the convergence in the number of particles, on which two filters run.
SIZES = ["particles=*", "*@particles=*"]


use rule run_filter as mapf with:
    output:
        runs("mapf", studies=["deadband", "saturation"], skip="*particles=20000"),


use rule run_filter as mapf_nc with:
    output:
        runs("mapf_nc", studies=["deadband", "saturation"], skip=SIZES),


use rule run_filter as mapf_nmc with:
    output:
        runs("mapf_nmc", studies=["deadband", "saturation"], skip=SIZES),


use rule run_filter as mpf with:
    output:
        runs("mpf", studies=["deadband", "saturation"]),


use rule run_filter as dead_reckoning with:
    output:
        runs("dead_reckoning", studies=["deadband", "saturation"], skip=SIZES),


use rule run_filter as pf_ross_eh with:
    output:
        runs("pf_ross_eh", studies=["ungm", "rss_2d", "rss_3d"]),


use rule run_filter as pf_ross with:
    output:
        runs(
            "pf_ross",
            studies=["ungm", "rss_2d", "rss_3d"],
            points=["base", "reading-*@base"],
        ),


use rule run_filter as pf_eh with:
    output:
        runs(
            "pf_eh",
            studies=["ungm", "rss_2d", "rss_3d"],
            points=["base", "reading-*@base"],
        ),


use rule run_filter as spf with:
    output:
        runs(
            "spf",
            studies=["ungm", "rss_2d", "rss_3d"],
            points=["base", "reading-*@base"],
        ),


use rule run_filter as spf_im with:
    output:
        runs(
            "spf_im",
            studies=["ungm", "rss_2d", "rss_3d"],
            points=["base", "reading-*@base"],
        ),


use rule run_filter as pf_ross_eh_exact with:
    output:
        runs(
            "pf_ross_eh_exact",
            studies=["ungm"],
            points=["base", "harvest=identity"],
        ),


use rule run_filter as pf_ross_eh_joint with:
    output:
        runs(
            "pf_ross_eh_joint",
            studies=["ungm"],
            points=["base", "harvest=identity"],
        ),


use rule run_filter as bkf_1 with:
    output:
        runs(
            "bkf_1",
            studies=["linear_losses", "radar", "quadrotor"],
            skip=["particles=*", "*@particles=*", "reading-far-*"],
        ),


use rule run_filter as bkf_2 with:
    output:
        runs(
            "bkf_2",
            studies=["linear_losses", "radar", "quadrotor"],
            skip=["particles=*", "*@particles=*", "reading-far-*", "reading-loss=*"],
        ),


use rule run_filter as rbpf with:
    output:
        runs("rbpf", studies=["linear_losses"], skip=["reading-many-*", "reading-loss=*"]),


use rule run_filter as rbpf_on_radar with:
    output:
        runs("rbpf", studies=["radar"], points=["loss=*", "poor-*"]),


use rule run_filter as rbpf_fast with:
    output:
        runs(
            "rbpf_fast",
            studies=["linear_losses"],
            points=[
                *("loss=0.5", "markov-*", "particles=*", "short-*"),
                *("reading-*@loss=0.5", "reading-*@short-*", "reading-many-*"),
            ],
            skip=["reading-prior=*", "reading-loss=*"],  # of BKF-II, and of BKF-I
        ),


# Where Algorithm 3 does not run, its results are Algorithm 4's, in a quarter of the time.
use rule run_filter as rbpf_fast_on_radar with:
    output:
        runs(
            "rbpf_fast",
            studies=["radar"],
            points=["loss=0.5", "markov-*", "particles=*", "pooled-*", "reading-*"],
        ),


# Algorithm 4 alone: its results are Algorithm 3's to the last bit, in an eighth of the time.
use rule run_filter as rbpf_fast_in_flight with:
    output:
        runs("rbpf_fast", studies=["quadrotor"], skip="reading-far-*"),


use rule run_filter as exact with:
    output:
        runs(
            "exact",
            studies=["linear_losses"],
            points=["short-*", "reading-*@short-*"],
        ),


use rule run_filter as sir_losses with:
    output:
        runs(
            "sir_losses",
            studies=["linear_losses"],
            points=["loss=*", "short-*", "reading-*@loss=*"],
            skip=["reading-prior=*", "reading-loss=*"],
        ),


use rule run_filter as sir_losses_on_radar with:
    output:
        runs("sir_losses", studies=["radar"], points=["markov-*", "reading-*@markov-*"]),


use rule run_filter as true_state with:
    output:
        runs("true_state", studies=["quadrotor"], skip="reading-far-*"),


use rule run_filter as ekf_no_loss with:
    output:
        runs("ekf_no_loss", studies=["quadrotor"]),


# What a filter must beat: drawn in no redrawing of a published figure.
use rule run_filter as prior with:
    output:
        runs(
            "prior",
            studies=["linear_delays", "wsn_tracking", "linear_losses", "radar"],
            points=["arrival=*", "n[0-9]-*", "loss=*"],
        ),


use rule run_filter as prior_of_sensors with:
    output:
        runs("prior", studies=["ungm", "rss_2d", "rss_3d"], points="base"),
