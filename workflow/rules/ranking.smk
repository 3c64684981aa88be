# How the filters rank: the leaderboard of all studies, and the figures that every study has.
rule study_figures:
    input:
        table=LAYOUT.ranking(),
        over_k=LAYOUT.error_over_k(),
        shares=LAYOUT.error_shares(),
    output:
        **{
            kind: report(
                f"{FIGURES}/studies/{{study}}/{kind}.png",
                category="Figures",
                subcategory="every filter",
                labels={"figure": f"{{study}}: {kind.replace('_', ' ')}"},
            )
            for kind in ("over_k", "over_sweep", "distribution")
        },
    log:
        LAYOUT.job_log("study_figures", "{study}"),
    benchmark:
        LAYOUT.timing("study_figures", "{study}")
    conda:
        ENVIRONMENT
    params:
        results=lambda wildcards, output: results_of([wildcards.study]),
        made_with=lambda wildcards: results_with([wildcards.study]),
        code=code("repro.plot.study_figures"),
    script:
        "../scripts/study_figures.py"


if RUN.filter is None:

    rule leaderboard:
        input:
            [LAYOUT.ranking(study) for study in STUDIES],
        output:
            csv=LAYOUT.page("leaderboard.csv"),
            times=LAYOUT.page("leaderboard_times.csv"),  # of this machine
            markdown=LAYOUT.page("leaderboard.md"),
        log:
            LAYOUT.job_log("leaderboard"),
        conda:
            ENVIRONMENT
        params:
            rankings={study: LAYOUT.ranking(study) for study in STUDIES},
            catalogue=REGISTRY.catalogue(*STUDIES),
            points={
                study: {
                    name: {
                        "family": point.family,
                        "trials": point.parameters.trials,
                        "steps": point.parameters.steps,
                    }
                    for name, point in points.items()
                }
                for study, points in STUDIES.items()
            },
            shards=RUN.shards,
            root=lambda wildcards: str(LAYOUT.root),
            code=code("repro.pages.leaderboard", "repro.workflow.timings"),
        script:
            "../scripts/leaderboard.py"

else:

    # A filter under development: --config filter=NAME study=STUDY [trials=100] [point=POINT]
    rule leaderboard:
        log:
            LAYOUT.job_log("quick_leaderboard"),
        conda:
            ENVIRONMENT
        params:
            study=asked_for("study"),
            point=RUN.point,
            filter=RUN.filter,
            settings=REGISTRY.settings(RUN.filter, RUN.study or ""),
            seed=RUN.root_seed,
            trials=RUN.trials or 100,
            tolerance=RUN.tolerance,
            code=code("repro.inspect.quick_ranking"),
        script:
            "../scripts/quick_leaderboard.py"
