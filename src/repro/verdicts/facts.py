"""Numbers that the reasons for a paper's verdicts state, computed from the results."""

from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pandas as pd

from repro.errors import ReproError
from repro.tables.csv_file import write_csv
from repro.tables.results import Results

Fact = Callable[[Results], Mapping[str, float]]  # numbers by name


def state(results: Results, paper: str, path: str | Path) -> None:
    """Write the facts of a paper: those of the functions FACTS of its module `facts`, if any."""
    module = f"repro.papers.{paper}.facts"
    facts: Iterable[Fact] = import_module(module).FACTS if find_spec(module) else ()
    numbers = {name: value for fact in facts for name, value in fact(results).items()}
    write_csv(pd.DataFrame({"name": list(numbers), "value": list(numbers.values())}), path)


def read_facts(path: str | Path) -> dict[str, float]:
    """The numbers that `state` has written, by name."""
    table = pd.read_csv(path)
    return dict(zip(table["name"], table["value"], strict=True))


def filled(reason: str, facts: Mapping[str, float], where: str) -> str:
    """A reason with its numbers: {name:.2f} is the fact of that name, formatted as Python does.

    Raises ReproError in one line for a fact that is not there.
    """
    try:
        return reason.format_map(facts)
    except KeyError as error:
        raise ReproError(
            f"{where}: reason: there is no fact {error.args[0]!r}; known are {', '.join(facts)}"
        ) from None
    except (ValueError, IndexError) as error:
        raise ReproError(f"{where}: reason: {error}; write {{name:.2f}}") from None
