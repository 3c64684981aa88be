"""Typed values: frozen models whose errors are one line each, and the kinds of number they hold."""

import json
import re
from collections.abc import Mapping
from typing import Annotated, Any, Self, get_args, get_origin

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import ErrorDetails

from repro.errors import ReproError

# What pydantic adds to the place of a fault where a value may be of several kinds.
UNION_MEMBER = re.compile(r"constrained-|literal\[|function-|tuple\[|(float|int|str|bool)$")
BOUNDS = {
    "greater_than_equal": "at least",
    "greater_than": "above",
    "less_than_equal": "at most",
    "less_than": "below",
}


class ParameterError(ReproError):
    """A parameter file, or --config, with a value that is wrong, unknown or missing."""


class Values(BaseModel):
    """Named values, checked and frozen. Bounds and units are in the fields."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    @classmethod
    def checked(cls, values: Mapping[str, Any], where: str) -> Self:
        """The values with their types. Raises ParameterError: `where`, the key and the fix."""
        try:
            # As JSON, a list may fill a tuple; the types of numbers stay strict.
            return cls.model_validate_json(json.dumps(values))
        except ValidationError as error:
            place, fix = _place_and_fix(error.errors(include_url=False), cls)
            inside = "." if ": " in where else ": "  # below a key of the file, or below the file
            raise ParameterError(f"{where}{inside if place else ''}{place}: {fix}") from None

    def plain(self) -> dict[str, Any]:
        """The values as JSON has them."""
        return self.model_dump(mode="json")


class PointParameters(Values):
    """What the parameters of every study have."""

    trials: int = Field(ge=1, description="number of trials, i.e. Monte Carlo runs")
    steps: int = Field(ge=1, description="number of steps")


class NoAnalysis(Values):
    """A study whose metrics have no threshold."""


def at_most(name: str, value: int, bound_name: str, bound: int) -> None:
    """Raise ValueError, as a validator must, if a value is above the bound that another gives."""
    if value > bound:
        raise ValueError(f"{name} is {value}; {bound_name} allows at most {bound}")


def _array(rows) -> np.ndarray:
    if len({len(row) for row in rows}) > 1:
        raise ValueError(f"rows must be of one length; they have {[len(row) for row in rows]}")
    return np.array(rows, dtype=float)


def _covariance(matrix):
    array = _array(matrix)
    if array.shape[0] != array.shape[1] or not np.array_equal(array, array.T):
        raise ValueError("must be a symmetric matrix")
    smallest = np.linalg.eigvalsh(array).min()
    if smallest < -1e-12 * max(1.0, np.abs(array).max()):
        raise ValueError(
            f"must be positive semidefinite; its smallest eigenvalue is {smallest:.6g}"
        )
    return matrix


def _stochastic(matrix):
    array = _array(matrix)
    if array.shape[0] != array.shape[1]:
        raise ValueError("must be a square matrix")
    if not np.allclose(array.sum(axis=1), 1.0, rtol=0, atol=1e-12):
        row = int(np.abs(array.sum(axis=1) - 1).argmax())
        raise ValueError(f"each row must sum to one; row {row} sums to {array[row].sum():.6g}")
    return matrix


def _rectangular(rows):
    _array(rows)
    return rows


Probability = Annotated[float, Field(ge=0, le=1)]
Positive = Annotated[float, Field(gt=0)]
NotNegative = Annotated[float, Field(ge=0)]
Pair = tuple[float, float]
Triple = tuple[float, float, float]
Covariance2 = Annotated[tuple[Pair, Pair], AfterValidator(_covariance)]
Row5 = tuple[float, float, float, float, float]
Covariance5 = Annotated[tuple[Row5, Row5, Row5, Row5, Row5], AfterValidator(_covariance)]
StochasticMatrix = Annotated[
    tuple[tuple[Probability, ...], ...], Field(min_length=2), AfterValidator(_stochastic)
]
Rectangular = AfterValidator(_rectangular)


def _place_and_fix(faults: list[ErrorDetails], model: type[BaseModel]) -> tuple[str, str]:
    """Where the first fault lies, and what to do about it."""
    place = _place(faults[0])
    # Of a value that may be of several kinds there is a fault for each kind; of a short tuple, one
    # for each entry that is missing.
    here = [fault for fault in faults if _place(fault) == place]
    return ".".join(map(str, place)), _fix(here, model)


def _place(fault: ErrorDetails) -> tuple[int | str, ...]:
    """Where the fault lies; of a missing or unknown key, where it would be."""
    place = fault["loc"]
    if fault["type"] in ("missing", "extra_forbidden"):
        place = place[:-1]
    return tuple(key for key in place if not (isinstance(key, str) and UNION_MEMBER.match(key)))


def _fix(faults: list[ErrorDetails], model: type[BaseModel]) -> str:
    """The faults of one value in words that say what to do."""
    fault = next((f for f in faults if f["type"] in BOUNDS), faults[0])
    value, key, context = fault["input"], fault["loc"][-1:], fault.get("ctx", {})
    match fault["type"]:
        case "missing" if isinstance(key[0], int):
            return f"{_entries(len(value))}; it must have {len(value) + len(faults)}"
        case "missing":
            return f"'{key[0]}' is missing; add it"
        case "extra_forbidden":
            known = ", ".join(_model_at(model, _place(fault)).model_fields)
            return f"unknown key '{key[0]}'; known keys are {known or 'none'}"
        case kind if kind in BOUNDS:
            (bound,) = context.values()
            size = "small" if kind.startswith("greater") else "large"
            return f"{value} is too {size}; it must be {BOUNDS[kind]} {bound:g}"
        case "too_short":
            return f"{_entries(context['actual_length'])}; at least {context['min_length']} needed"
        case "too_long":
            return f"{_entries(context['actual_length'])}; at most {context['max_length']} allowed"
        case "string_too_short":
            return "is empty; it must have at least one character"
        case "string_pattern_mismatch":
            return f"{_shown(value)} has a wrong character; it must match {context['pattern']}"
        case "value_error":
            return str(context["error"])
    allowed = list(dict.fromkeys(_allowed(fault) for fault in faults))
    return f"{_shown(value)} is not {' or '.join(allowed)}"


def _entries(count: int) -> str:
    return f"has {count} {'entry' if count == 1 else 'entries'}"


def _shown(value: Any) -> str:
    """A value as it is written in YAML, cut short."""
    text = json.dumps(value) if value is None or isinstance(value, bool) else repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _allowed(fault: ErrorDetails) -> str:
    """What a value of the wrong kind should be."""
    if fault["type"] == "literal_error":
        return fault.get("ctx", {})["expected"]
    kinds = {"int": "an integer", "float": "a number", "bool": "true or false"}
    kinds |= {"string": "a string", "tuple": "a list", "model": "a mapping", "dict": "a mapping"}
    return kinds.get(fault["type"].split("_")[0], f"a {fault['type'].split('_')[0]}")


def _model_at(kind: Any, place: tuple[int | str, ...]) -> type[BaseModel]:
    """The model that checks what is at a place inside another model."""
    for key in place:
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            kind = kind.model_fields[str(key)].annotation
        else:  # dict[str, value] or list[value]
            kind = get_args(kind)[-1]
        while get_origin(kind) is Annotated:
            kind = get_args(kind)[0]
    return kind
