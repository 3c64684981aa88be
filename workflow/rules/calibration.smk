# What was fitted to the papers' numbers, fitted again, by the papers' own rules. On request: about
# 20 minutes on two cores; --config budget=0.1 takes a tenth of the effort.
rule calibration:
    input:
        CALIBRATIONS,
    log:
        LAYOUT.job_log("calibration"),
    conda:
        ENVIRONMENT
    script:
        "../scripts/calibration.py"
