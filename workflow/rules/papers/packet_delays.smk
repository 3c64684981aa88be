# The example of [packet_delays Table 1], which comes from no trials.
COMPUTED_TABLES["packet_delays"].append("packet_example")


rule packet_example:
    output:
        LAYOUT.table("packet_example"),
    log:
        LAYOUT.job_log("packet_example"),
    conda:
        ENVIRONMENT
    params:
        example=PAPERS["packet_delays"].examples["table_1"],
        code=code("repro.papers.packet_delays.packet_example"),
    script:
        "../../scripts/papers/packet_example.py"


# The turn-rate variance, the channel and S(0), fitted again to Table 2.
CALIBRATIONS += [
    LAYOUT.calibration("table_2.csv"),
    f"{FIGURES}/packet_delays/calibration.png",
]


rule table_2_profile:
    input:
        published="params/published/packet_delays.csv",
    output:
        LAYOUT.calibration("table_2.csv"),
    log:
        LAYOUT.job_log("table_2_profile"),
    benchmark:
        LAYOUT.timing("table_2_profile")
    conda:
        ENVIRONMENT
    params:
        points=plain_points("wsn_tracking"),
        grid=PAPERS["packet_delays"].calibration,
        budget=RUN.budget,
        seed=RUN.root_seed,
        tolerance=RUN.tolerance,
        code=code(
            "repro.papers.packet_delays.calibration",
            "repro.studies.wsn_tracking",
            "repro.filters.emvf",
        ),
    script:
        "../../scripts/papers/table_2_profile.py"
