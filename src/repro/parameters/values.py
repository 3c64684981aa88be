"""Typed values: frozen models whose faults are one line each, and the kinds of number they hold."""

import json
import re
from collections.abc import Mapping
from typing import Annotated, Any, Self

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import ErrorDetails

from repro.errors import ReproError

# What pydantic adds to the place of a fault where a value may be of several kinds.
UNION_MEMBER = re.compile(r"constrained-|literal\[|function-|tuple\[|(float|int|str|bool)$")


class ParameterError(ReproError):
    """A parameter file that says something it must not, or lacks something it must say."""


class Values(BaseModel):
    """Named values of one kind, checked. Units and bounds stand in the fields."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    @classmethod
    def checked(cls, values: Mapping[str, Any], where: str) -> Self:
        """The values with their types. Raises ParameterError: `where`, the key and the fix."""
        try:
            # As JSON, a list may fill a tuple; the types of numbers stay strict.
            return cls.model_validate_json(json.dumps(values))
        except ValidationError as error:
            fault = error.errors(include_url=False)[0]
            place = ".".join(str(key) for key in _place(fault))
            raise ParameterError(
                f"{where}{'.' if place else ''}{place}: {_fix(fault, cls)}"
            ) from None

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


def _place(fault: ErrorDetails) -> tuple[int | str, ...]:
    """Where the fault lies; of a missing or unknown key, where it would stand."""
    place = fault["loc"]
    if fault["type"] in ("missing", "extra_forbidden"):
        place = place[:-1]
    return tuple(key for key in place if not (isinstance(key, str) and UNION_MEMBER.match(key)))


def _fix(fault: ErrorDetails, model: type[BaseModel]) -> str:
    """A fault in words that say what to do."""
    value, context = fault["input"], fault.get("ctx", {})
    match fault["type"]:
        case "missing" if isinstance(fault["loc"][-1], int):
            return f"has {len(value)} entries; more are needed"
        case "missing":
            return f"'{fault['loc'][-1]}' is missing; add it"
        case "extra_forbidden":
            known = ", ".join(model.model_fields)
            return f"unknown key '{fault['loc'][-1]}'; known are {known}"
        case "greater_than_equal" | "greater_than" | "less_than_equal" | "less_than" as kind:
            words = {"ge": "at least", "gt": "above", "le": "at most", "lt": "below"}
            (bound,) = context
            size = "small" if kind.startswith("greater") else "large"
            return f"{value} is too {size}; it must be {words[bound]} {context[bound]:g}"
        case "literal_error":
            return f"'{value}' is not one of {context['expected'].replace(chr(39), '')}"
        case "too_short" | "too_long":
            return f"has {context['actual_length']} entries; {fault['msg']}"
        case "value_error":
            return str(context["error"])
        case kind if kind.endswith(("_type", "_parsing", "_from_float")):
            return f"{value!r} is not {_kind(kind)}"
    return " ".join(fault["msg"].split())


def _kind(fault: str) -> str:
    names = {"int": "an integer", "float": "a number", "bool": "true or false"}
    names |= {"string": "a string", "tuple": "a list", "model": "a mapping"}
    return names.get(fault.split("_")[0], f"a {fault.split('_')[0]}")
