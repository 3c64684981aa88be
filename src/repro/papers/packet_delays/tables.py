"""The printed tables of [packet_delays] of which all cells are tested together."""

import numpy as np

from repro.papers.packet_delays.claims.errors import mean_error
from repro.papers.packet_delays.points import table_2
from repro.statistics import metrics
from repro.tables.results import Results
from repro.verdicts.joint import Cells, Tables


def saee(results: Results) -> Cells:
    """Table 2: the 15 cells meet the same truth, sensors, noise and uniforms of the network."""
    cells = [(bound, p) for bound, arrivals in table_2(results).items() for p in arrivals]
    per_trial = np.stack([mean_error(results, bound, p) for bound, p in cells], axis=1)
    return Cells(
        items=[f"Table 2: N={bound} p={p}" for bound, p in cells],
        left_out=metrics.leave_one_out(per_trial, lambda mean: mean),
    )


TABLES: Tables = {"Table 2": saee}
