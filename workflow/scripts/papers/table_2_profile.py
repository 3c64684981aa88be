from repro.papers.packet_delays.calibration import Grid, printed_cells, tabulate
from repro.workflow.job import job

params = snakemake.params
with job(snakemake.log[0]):
    grid = Grid.checked(params.grid, "params/packet_delays.yaml: calibration")
    grid = grid.with_budget(params.budget)
    printed = printed_cells(snakemake.input.published)
    tabulate(params.points, grid, printed, params.seed, params.tolerance, snakemake.output[0])
