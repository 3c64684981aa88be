"""The points of a study, resolved from the families of its parameter file."""

import itertools
import math
import re
from collections.abc import Iterator, Mapping
from fnmatch import fnmatchcase
from types import SimpleNamespace
from typing import Any, NamedTuple

from repro.parameters.paper_file import Family, StudySection, plain
from repro.parameters.point_names import OF, is_plain
from repro.parameters.values import ParameterError

FOLDER = re.compile(r"[^./{}][^/{}]{0,199}")  # what the name of a point may be
MOST_POINTS = 10_000  # of a family


class Resolved(NamedTuple):
    """The values of a point before their types are known."""

    name: str
    parameters: dict[str, Any]
    filters: dict[str, dict[str, Any]]
    family: str
    swept: dict[str, Any]


def resolved(
    section: StudySection, family: Family, above: Mapping[str, Resolved], where: str
) -> Iterator[Resolved]:
    """The points of a family: base, then `set`, then sweep; the base is a point if `of` says so."""
    where = f"{where}: {family.name}"
    if not family.of:
        settings = {name: plain(values) for name, values in section.filters.items()}
        base = Resolved("", plain(section.parameters), settings, "", {})
        yield from _swept(family, base, where)
        return
    read = [p for name, p in above.items() if is_plain(name) and _matches(name, family.of)]
    if not read:
        raise ParameterError(f"{where}: of: no point above matches {', '.join(family.of)}")
    for base in read:
        yield from _swept(family, base, where)


def _matches(name: str, patterns: list[str]) -> bool:
    return any(fnmatchcase(name, pattern) for pattern in patterns)


def _swept(family: Family, base: Resolved, where: str) -> Iterator[Resolved]:
    """The points of a family that differ from `base`, which keeps its name in theirs."""
    first = base.parameters | family.set
    settings = dict(base.filters)
    for name, changes in family.filters.items():
        _check_known(name, settings, where)
        settings[name] = settings[name] | changes
    count = math.prod(map(len, family.sweep.values()))
    if count > MOST_POINTS:
        raise ParameterError(
            f"{where}: its sweep has {count} points; at most {MOST_POINTS} allowed"
        )
    of, of_family = (OF * bool(of) + of for of in (base.name, base.family))
    for values in itertools.product(*family.sweep.values()):
        parameters, filters = dict(first), {name: dict(own) for name, own in settings.items()}
        for keys, value in zip(family.sweep, values, strict=True):
            for key in keys.replace(" ", "").split(","):
                filter_, dot, setting = key.partition(".")
                if dot:
                    _check_known(filter_, settings, f"{where}: sweep")
                    filters[filter_][setting] = value
                else:
                    parameters[key] = value
        name = _name(family.name, parameters, filters, where) + of
        swept = base.swept | dict(zip(family.sweep, values, strict=True))
        yield Resolved(name, parameters, filters, family.name + of_family, swept)


def _check_known(filter_: str, settings: dict[str, dict], where: str) -> None:
    if filter_ not in settings:
        raise ParameterError(
            f"{where}: no settings of a filter '{filter_}'; known are {', '.join(settings)}"
        )


def _name(pattern: str, parameters: dict, filters: dict, where: str) -> str:
    """The name of a point: {parameter} and {filter.setting} are filled in."""
    named = {name: SimpleNamespace(**values) for name, values in filters.items()}
    try:
        name = pattern.format(**named | parameters)
    except (KeyError, AttributeError) as error:
        unknown = error.name if isinstance(error, AttributeError) else error.args[0]
        raise ParameterError(
            f"{where}: point name '{pattern}': there is no parameter or setting '{unknown}'"
        ) from None
    except (IndexError, TypeError, ValueError) as error:
        raise ParameterError(f"{where}: point name '{pattern}': {error}; fix its braces") from None
    if not (FOLDER.fullmatch(name) and name.isprintable()):
        raise ParameterError(
            f"{where}: point name '{name}': it names a folder: at most 200 characters, no / {{ }}, "
            "and no dot at its start"
        )
    return name
