# What only this paper has: the example of its Table 1.
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
