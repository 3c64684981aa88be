"""The search for a geometry that gives Tables I and II: random starts, then a local search."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from repro.atomic import atomic_write
from repro.papers.censored_network.calibration import Network, Printed, Row, Search, misfit
from repro.streams import Streams
from repro.tables.csv_file import write_csv

STREAMS = "censored_network"  # a search is of both studies: its streams are those of neither
COMMITTED = 0  # the start of this number is the geometry of the parameter file
GROW, SHRINK = 1.524, 0.9  # GROW SHRINK^4 = 1: one success in five keeps the step


class Fit(NamedTuple):
    """A geometry found, judged on trials that the search has not seen and by all particles."""

    left_out: Row | None  # the row of the tables that the search has not seen
    start: int
    shares: np.ndarray  # the geometry as a point of the box
    searched: np.ndarray  # misfit on the trials of the search, at its start and at its end
    value: np.ndarray  # time-averaged RMSE of all rows, (rows, targets), in m
    jackknife: np.ndarray  # the same with one trial left out each, (trials, rows, targets)


def screen(network: Network, printed: Printed, path: str | Path) -> None:
    """Write the averages of geometries drawn uniformly in the box, which no row has guided.

    A line has the shares of the box, then the averages by row and target.
    """
    box, screened = network.box, range(network.search.screened)
    drawn = Streams(network.seed, STREAMS, "calibration screen", screened).uniform(box.dimension)
    columns = [f"share_{i}" for i in range(box.dimension)]
    columns += [" ".join(row) + f" {i}" for row in printed.rows for i in (1, 2, 3)]
    lines = []
    for shares in drawn:
        found = network.searched(box.geometry(shares), printed.rows)
        lines.append(dict(zip(columns, [*shares.tolist(), *found.ravel().tolist()], strict=True)))
    write_csv(lines, path)


def fit(
    network: Network, printed: Printed, screened: np.ndarray, left_out: Row | None, start: int
) -> Fit:
    """Search from the committed geometry (start 0), or from the start-th best of the screened.

    The search, and the choice of its start, see every row but `left_out`; its result is judged
    on all.
    """
    box, seen = network.box, printed.without(left_out)

    def objective(shares: np.ndarray) -> float:
        return float(misfit(network.searched(box.geometry(shares), seen.rows), seen))

    if start == COMMITTED:
        first = box.shares(network.committed)
    else:
        first = _ranked(screened, printed, seen)[start - 1]
    name = " ".join(left_out or ("all",))
    streams = Streams(network.seed, STREAMS, f"calibration search {name}", [start])
    best, searched = local_search(objective, first, streams.generators[0], network.search)
    return Fit(
        left_out, start, best, searched, *network.confirmed(box.geometry(best), printed.rows)
    )


def local_search(
    objective: Callable[[np.ndarray], float],
    first: np.ndarray,
    generator: np.random.Generator,
    search: Search,
) -> tuple[np.ndarray, np.ndarray]:
    """The best point found in the unit cube, and the objective at the first point and at it.

    A (1+1) evolution strategy with the one-fifth rule: a normal step in all coordinates is taken
    if it lowers the objective; steps grow with success and shrink without.
    """
    best, step = first, search.first_step
    lowest = begun = objective(best)
    for _ in range(search.evaluations - 1):
        tried = reflected(best + step * generator.standard_normal(len(best)))
        found = objective(tried)
        if found < lowest:
            best, lowest, step = tried, found, step * GROW
        else:
            step *= SHRINK
    return best, np.array([begun, lowest])


def reflected(shares: np.ndarray) -> np.ndarray:
    """A point outside the unit cube, mirrored at its walls until it is inside."""
    within_two = np.mod(shares, 2.0)
    return np.where(within_two > 1.0, 2.0 - within_two, within_two)


def write_fit(found: Fit, path: str | Path) -> None:
    """Write the file that `read_fit` reads."""
    arrays = found._replace(left_out=np.array(found.left_out or (), dtype=str))._asdict()
    with atomic_write(path) as part, part.open("wb") as stream:
        np.savez(stream, **arrays)


def read_fit(path: str | Path) -> Fit:
    """A fit as `write_fit` has written it."""
    with np.load(path) as stored:
        found = Fit(**stored)
    row = tuple(np.asarray(found.left_out).tolist())
    return found._replace(left_out=row or None, start=int(found.start))


def _ranked(screened: np.ndarray, printed: Printed, seen: Printed) -> np.ndarray:
    """Points of the box that were screened, those first that are best on the rows seen."""
    averages = printed.values.size
    found = screened[:, -averages:].reshape(len(screened), *printed.values.shape)
    kept = [printed.rows.index(row) for row in seen.rows]
    return screened[np.argsort(misfit(found[:, kept], seen), kind="stable"), :-averages]
