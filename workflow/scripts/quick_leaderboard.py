from repro.inspect.quick_ranking import quick_ranking
from repro.workflow.job import job

params = snakemake.params
with job(snakemake.log[0]):
    table = quick_ranking(
        params.study,
        params.point,
        params.filter,
        params.settings,
        params.seed,
        params.trials,
        params.tolerance,
    )
    print(table.to_string(float_format=lambda value: f"{value:.4g}"))
