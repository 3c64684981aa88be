# Stop 2 of the data: ground truth and impaired measurements as logs, those of a batch in one job.
for study, batch, points in REGISTRY.batches():

    rule:
        name:
            f"simulate_{study}_{batch}"
        output:
            [LAYOUT.log(study, point) for point in points],
        log:
            LAYOUT.job_log("simulate", study, batch, "{shard}"),
        benchmark:
            LAYOUT.timing("simulate", study, batch, "{shard}")
        conda:
            ENVIRONMENT
        params:
            study=study,
            points=lambda wildcards, output, study=study, points=tuple(points): simulated_points(
                study, points
            ),
            made_with=lambda wildcards, study=study, points=tuple(points): simulated_with(
                study, points
            ),
            shards=RUN.shards,
            seed=RUN.root_seed,
            code=code("repro.simulate", f"repro.studies.{study}"),
        script:
            "../scripts/simulate.py"
