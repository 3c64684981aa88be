"""Logs with one fault each: refused in one line, or read as the log without the fault."""

import random
from collections.abc import Callable
from pathlib import Path

import numpy as np

from repro.errors import ReproError
from repro.logs import Log, write_log
from repro.logs.user_log import read_user_log
from repro.runner import FilteredPoint, run_filter
from tests.conftest import small_log
from tests.unit import test_fuzz

STUDY, POINT, FILTER = "linear_delays", "arrival=0.5", "omvf"
LOG = small_log(STUDY, POINT, trials=2, steps=4)
ORIGIN = "made, trials 0 to 1"


def pieces_replaced(chance: random.Random, path: Path) -> None:
    """Some bytes replaced, inserted or cut; the fuzzed readers must end in one line too."""
    changes = [
        (chance.randrange(10**4), chance.randbytes(chance.randrange(12)), chance.randrange(10))
        for _ in range(chance.randint(1, 4))
    ]
    test_fuzz.test_a_log_with_pieces_replaced.hypothesis.inner_test(changes, path.parent)


def one_bit_changed(chance: random.Random, path: Path) -> None:
    """A single bit."""
    data = bytearray(path.read_bytes())
    data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    path.write_bytes(data)


def cut_off(chance: random.Random, path: Path) -> None:
    """The end is missing."""
    data = path.read_bytes()
    path.write_bytes(data[: chance.randrange(len(data))])


def topics_swapped(chance: random.Random, path: Path) -> None:
    """Two topics carry each other's messages."""
    first, second = chance.sample(sorted(LOG.fields), 2)
    swap = {first: second, second: first}
    values = {swap.get(topic, topic): value for topic, value in LOG.values.items()}
    fields = {swap.get(topic, topic): names for topic, names in LOG.fields.items()}
    _write(path, LOG._replace(values=values, fields=fields))


def not_finite(chance: random.Random, path: Path) -> None:
    """A number that is none, in some message of a log of one's own."""
    topic = chance.choice(sorted(LOG.fields))
    values = LOG.values[topic].copy()
    values[tuple(chance.randrange(n) for n in values.shape)] = chance.choice([np.nan, np.inf])
    _write(path, LOG._replace(values=LOG.values | {topic: values}))
    read_user_log(path, LOG.fields, STUDY, POINT, LOG.parameters)


def of_another_study(chance: random.Random, path: Path) -> None:
    """A good log, but of another study or point."""
    study, point = chance.choice([(STUDY, "arrival=0.9"), ("ungm", "base"), ("radar", "loss=0.5")])
    _write(path, small_log(study, point, trials=2, steps=4))


def stale(chance: random.Random, path: Path) -> None:
    """A good log, but made with other trials, or with other parameters, seed or code."""
    trials = chance.randint(2, 9)
    _write(path, LOG, chance.choice([f"made, trials 0 to {trials}", "else, trials 0 to 1", ""]))


WRONG: dict[str, Callable[[random.Random, Path], None]] = {
    wrong.__name__: wrong
    for wrong in (
        pieces_replaced,
        one_bit_changed,
        cut_off,
        topics_swapped,
        not_finite,
        of_another_study,
        stale,
    )
}


def _write(path: Path, log: Log, origin: str = ORIGIN) -> None:
    write_log(path, log, 0.5, origin=origin)


def right_runs(folder: Path) -> bytes:
    """What the filter makes of the log without a fault."""
    log = folder / "right.mcap"
    _write(log, LOG)
    return _filtered(log, folder / "right.npz")


def _filtered(log: Path, runs: Path) -> bytes:
    point = FilteredPoint(str(log), {}, ORIGIN, "")
    run_filter(STUDY, FILTER, {POINT: point}, runs)
    return runs.read_bytes()


def fault_of(kind: str, chance: random.Random, folder: Path, right: bytes) -> str | None:
    """What is wrong with how a wrong log is taken; None if nothing is."""
    log, runs = folder / "0.mcap", folder / "0.npz"
    _write(log, LOG)
    runs.unlink(missing_ok=True)
    try:
        WRONG[kind](chance, log)
        found = _filtered(log, runs)
    except ReproError as error:
        one_line = "\n" not in str(error) and "0.mcap" in str(error)
        return None if one_line and not runs.exists() else f"{kind}: {error!r}"
    except Exception as error:  # whatever it is, it should have been one line
        return f"{kind}: {error!r}"
    return None if found == right else f"{kind}: a changed log was taken for a good one"
