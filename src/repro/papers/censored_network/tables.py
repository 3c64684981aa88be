"""The cells of Tables I and II of censored_network, compared with the printed ones jointly."""

from functools import partial

import numpy as np

from repro.papers.censored_network.time_averages import PUBLISHED, time_average
from repro.studies.families.censored_network import COMPONENTS
from repro.tables.results import Results
from repro.verdicts.joint import Cells, Tables
from repro.verdicts.published import read_published

AVERAGE = COMPONENTS[-1]  # a linear combination of the others


def cells(results: Results, study: str) -> Cells:
    """The targets of every filter; the runs are paired, so that the cells depend on each other."""
    rows = read_published(PUBLISHED)
    of_table = (rows["study"] == study) & (rows["kind"] == "value")
    rows = rows[of_table & (rows["component"] != AVERAGE)]
    averages = {filter_: time_average(results, study, filter_) for filter_ in set(rows["filter"])}
    left_out = [
        averages[filter_].left_out[:, COMPONENTS.index(component)]
        for filter_, component in zip(rows["filter"], rows["component"], strict=True)
    ]
    return Cells(list(rows["item"]), np.stack(left_out, axis=1))


TABLES: Tables = {
    "Table I": partial(cells, study="deadband"),
    "Table II": partial(cells, study="saturation"),
}
