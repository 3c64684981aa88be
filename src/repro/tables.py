"""Tables and curves of a study, in long form, each number with its Monte Carlo standard error."""

from pathlib import Path
from types import ModuleType

import numpy as np
import pandas as pd

from repro.network import packet_delays
from repro.results import Results
from repro.shards import Shards
from repro.studies import study_module
from repro.whole import whole


def write_csv(rows: list[dict] | pd.DataFrame, path: str | Path) -> None:
    """One way of writing numbers, so that equal results are equal bytes."""
    with whole(path) as part:
        pd.DataFrame(rows).to_csv(part, index=False, float_format="%.9g", lineterminator="\n")


def tabulate(results: Results, study: str, table: str | Path, curves: str | Path) -> None:
    """Write the table and the curves of every point and filter of a study."""
    module = study_module(study)
    rows, over_k = [], []
    for point, filters in results.catalogue[study].items():
        for filter_ in filters:
            shards = results.in_shards(study, point, filter_)
            degenerate = shards.each(lambda runs: runs.degenerate).mean()
            lost = _share_lost(module, shards)
            where = {"study": study, "point": point, "filter": filter_}
            for metric, component, statistic in module.rows(shards):
                rows.append(
                    where
                    | {"metric": metric, "component": component}
                    | {"value": statistic.value, "mcse": statistic.mcse}
                    | {"trials": shards.trials, "median": statistic.median}
                    | {"q10": statistic.q10, "q90": statistic.q90}
                    | {"lost": lost, "degenerate": degenerate}
                )
            for metric, component, statistic in module.curves(shards):
                over_k.append(
                    pd.DataFrame(
                        where
                        | {"metric": metric, "component": component}
                        | {"k": np.arange(len(statistic.value)), "value": statistic.value}
                        | {"mcse": statistic.mcse, "median": statistic.median}
                        | {"q10": statistic.q10, "q90": statistic.q90}
                    )
                )
    write_csv(rows, table)
    write_csv(pd.concat(over_k), curves)


def _share_lost(module: ModuleType, shards: Shards) -> float:
    """Share of the runs that lost their target; NaN where a study knows no such thing."""
    if module.lost(shards.first) is None:
        return np.nan
    return shards.each(module.lost).mean()


def tabulate_packet_example(name: str, example: dict, path: str | Path) -> None:
    """Table 1 of Liu, Xu, Shi 2012: the packet that arrives at k = 1, 2, ... for given flags."""
    flags = np.array(example["flags"], dtype=float)
    before = np.ones((1, len(flags), 1))  # k = 0, which the table leaves out
    delay = packet_delays.delays(
        np.concatenate([before, flags[None]], axis=2), example["packet_bound"]
    )
    origin = packet_delays.origins(delay)[0, 1:]
    write_csv(
        [
            {"study": "packet_example", "point": name, "filter": "-", "metric": "received_packet"}
            | {"component": f"k={k}", "value": int(packet), "mcse": 0.0, "trials": 1}
            for k, packet in enumerate(origin, start=1)
        ],
        path,
    )
