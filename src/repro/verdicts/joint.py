"""Whether a printed table as a whole agrees with ours: its cells share their trials."""

from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from repro.errors import ReproError
from repro.tables.csv_file import write_csv
from repro.tables.results import Results
from repro.verdicts.published import read_published

COLUMNS = ["paper", "table", "cells", "trials", "chi_square", "p_value", "farthest", "z"]


class Cells(NamedTuple):
    """The cells of a printed table by their published names, from the same trials."""

    items: list[str]
    left_out: np.ndarray  # each of our numbers with one trial left out, (trials, cells)


Tables = Mapping[str, Callable[[Results], Cells]]  # by the name of the table


class Joint(NamedTuple):
    """The test of all cells of a table together."""

    chi_square: float
    p_value: float
    z: np.ndarray  # of each cell alone, (cells,)


def joint_test(
    left_out: np.ndarray, published: np.ndarray, digits: np.ndarray, their_trials: np.ndarray
) -> Joint:
    """Test that our cells and the printed ones, all arrays (cells,), have the same expectations.

    The covariance of the differences is that of our cells by the jackknife, the same at the paper's
    number of trials, and that of the rounding. As it is estimated from our trials, the p-value is
    that of Hotelling's T^2; with many trials it is that of chi-square. It is NaN if there are not
    more trials than cells.
    """
    from scipy.special import fdtrc  # only here, as it takes long to import

    trials, cells = left_out.shape
    ours = left_out.mean(axis=0)
    scatter = left_out - ours
    covariance = (trials - 1) / trials * (scatter.T @ scatter)
    theirs = covariance * trials / np.sqrt(np.outer(their_trials, their_trials))
    total = covariance + theirs + np.diag(10.0 ** (-2 * digits) / 12)
    difference = ours - published
    chi_square = float(difference @ np.linalg.solve(total, difference))
    free = trials - cells
    scaled = chi_square * free / (cells * (trials - 1))
    p_value = float(fdtrc(cells, free, scaled)) if free > 0 else np.nan
    return Joint(chi_square, p_value, difference / np.sqrt(np.diag(total)))


def compare_tables(results: Results, paper: str, published: str | Path, path: str | Path) -> None:
    """Write a row for each printed table of a paper: those of TABLES of its module `tables`."""
    module = f"repro.papers.{paper}.tables"
    tables: Tables = import_module(module).TABLES if find_spec(module) else {}
    values = read_published(published).set_index("item")
    rows = []
    for name, cells_of in tables.items():
        items, left_out = cells_of(results)
        unknown = [item for item in items if item not in values.index]
        if unknown:
            raise ReproError(f"{published}: {name}: there is no value '{unknown[0]}'")
        printed = values.loc[items]
        numbers = (printed[column].astype(float) for column in ("value", "digits", "trials"))
        joint = joint_test(left_out, *(column.to_numpy() for column in numbers))
        rows.append(_row(paper, name, items, len(left_out), joint))
    write_csv(pd.DataFrame(rows, columns=COLUMNS), path)


def _row(paper: str, name: str, items: list[str], trials: int, joint: Joint) -> dict[str, Any]:
    farthest = int(np.abs(joint.z).argmax())
    return {
        "paper": paper,
        "table": name,
        "cells": len(items),
        "trials": trials,
        "chi_square": joint.chi_square,
        "p_value": joint.p_value,
        "farthest": items[farthest],
        "z": joint.z[farthest],
    }
