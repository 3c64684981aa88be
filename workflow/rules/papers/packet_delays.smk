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
