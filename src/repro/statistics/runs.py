"""The result of a filter on the trials of a point, and the file that holds those of a batch."""

import io
import zipfile
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import BinaryIO, NamedTuple, Self

import numpy as np

from repro.origin import check_origin

LARGEST = 1e38  # that single precision holds


class Runs(NamedTuple):
    """What a filter's jobs keep of one (study, point), all trials in order."""

    error: np.ndarray  # (trials, steps, n)
    claimed: np.ndarray | None  # claimed error variances, ([trials,] steps, n)
    degenerate: np.ndarray  # guarded updates, (trials,)
    recorded: dict[str, np.ndarray]  # what the closed loop decided
    flown: dict[str, np.ndarray] | None = None  # topics of a closed loop's log; not in the file


class RunsWriter:
    """Writes the runs of one point after another, so that those of one are in memory at a time.

    The file is what np.savez writes, its arrays named <point>/<quantity>. Numbers of every step
    are single precision, 6e-8 of their size, and of the errors only the components that the
    study's metrics and figures read are kept; whoever wants more runs the filter on the log again.
    """

    def __init__(self, stream: BinaryIO, components: Sequence[int] | None = None):
        """`components` of the error are kept; None keeps all."""
        self._archive = zipfile.ZipFile(stream, "w")
        self._components = components

    def add(self, point: str, runs: Runs, origin: str = "") -> None:
        """Write the runs of a point; `origin` is what their readers ask for."""
        n = runs.error.shape[2]
        components = np.arange(n) if self._components is None else np.array(self._components)
        arrays = {"error": runs.error[..., components], "components": np.array([n, *components])}
        arrays |= {"degenerate": runs.degenerate, "origin": np.array(origin)}
        if runs.claimed is not None:
            arrays["claimed"] = runs.claimed
        arrays |= {f"recorded/{name}": value for name, value in runs.recorded.items()}
        for name, value in arrays.items():
            with self._archive.open(f"{point}/{name}.npy", "w", force_zip64=True) as entry:
                np.lib.format.write_array(entry, _compact(value), allow_pickle=False)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._archive.close()


def read_runs(path: str | Path, point: str, origin: str | None = None) -> Runs:
    """The runs of a point from the file of its batch; components that were not kept are NaN.

    Raises ReproError if `origin` is given, and the runs have another.
    """
    if origin is not None:
        check_runs(path, point, origin)
    archive = _archive(path)
    names = [name for name in archive.names if name.startswith(f"{point}/")]
    of_point = {name.removeprefix(f"{point}/"): _whole(archive.read(name)) for name in names}
    n, *components = of_point["components"]
    kept = of_point["error"]
    if len(components) == n:
        error = kept
    else:  # a component is contiguous, as they are read one by one
        error = np.moveaxis(np.empty((n, *kept.shape[:2])), 0, -1)
        error[..., np.setdiff1d(np.arange(n), components)] = np.nan
        for place, component in enumerate(components):
            error[..., component] = kept[..., place]
    recorded = [name for name in of_point if name.startswith("recorded/")]
    return Runs(
        error=error,
        claimed=of_point.get("claimed"),
        degenerate=of_point["degenerate"],
        recorded={name.removeprefix("recorded/"): of_point[name] for name in recorded},
    )


def check_runs(path: str | Path, point: str, origin: str) -> None:
    """Raise ReproError unless the file has runs of the point of that origin."""
    archive, name = _archive(path), f"{point}/origin"
    found = archive.read(name).item() if name in archive.names else ""
    check_origin(f"{path}, {point}", found, origin)


def read_trials(path: str | Path, point: str) -> int:
    """How many trials of a point the file of its batch has."""
    return len(_archive(path).read(f"{point}/degenerate"))


class Archive:
    """A file of runs that stays open: to list it takes as long as to read a point."""

    def __init__(self, path: str | Path):
        self._file = zipfile.ZipFile(path)
        self.names = {name.removesuffix(".npy"): None for name in self._file.namelist()}

    def read(self, name: str) -> np.ndarray:
        """The array of that name."""
        return np.lib.format.read_array(io.BytesIO(self._file.read(f"{name}.npy")))


def _archive(path: str | Path) -> Archive:
    found = Path(path).stat()
    return _opened(str(path), found.st_ino, found.st_size, found.st_mtime_ns)


@lru_cache(maxsize=64)
def _opened(path: str, *_: int) -> Archive:
    """The archive of a path; a file that took its place is another."""
    return Archive(path)


def _compact(values: np.ndarray) -> np.ndarray:
    """As it is stored: numbers of every step in few bytes; in all of them if a filter diverges."""
    if values.ndim < 2 or values.dtype.kind not in "fi" or values.size == 0:
        return np.ascontiguousarray(values)
    largest = np.fmax.reduce(np.abs(values), axis=None)
    if values.dtype.kind == "i":
        return values.astype(np.min_scalar_type(-1 - int(largest)))
    return np.ascontiguousarray(values) if largest > LARGEST else values.astype(np.float32)


def _whole(values: np.ndarray) -> np.ndarray:
    """As it was before it was stored, but for the rounding."""
    wide = {"f": float, "i": int}.get(values.dtype.kind)
    return values if wide is None else values.astype(wide, copy=False)
