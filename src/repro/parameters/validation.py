"""Checking content against a JSON schema, with keywords for what parameters must be together."""

from functools import cache
from pathlib import Path

import numpy as np
import yaml
from jsonschema import Draft202012Validator, ValidationError, validators
from jsonschema.exceptions import best_match

from repro.parameters.yaml_file import Loader, ParameterError


def _array(content) -> np.ndarray | None:
    """Numbers as an array, rows of different lengths as an empty one; None if not all are numbers.

    The type of what is no number is reported by its own keyword.
    """
    try:
        return np.array(content, dtype=float)
    except TypeError:
        return None
    except ValueError:
        return np.empty(0) if all(isinstance(row, list | tuple) for row in content) else None


def _rectangular(validator, wanted, rows, schema):
    """Schema keyword `rectangular: true`: rows of one length."""
    if not isinstance(rows, list | tuple) or not all(isinstance(r, list | tuple) for r in rows):
        return
    if len({len(row) for row in rows}) > 1:
        yield ValidationError(f"rows must be of one length; they have {[len(row) for row in rows]}")


def _size(content: dict, name: str):
    """A number, or the length of a list."""
    value = content.get(name)
    return len(value) if isinstance(value, list | tuple) else value


def _length(validator, wanted, content, schema):
    """Schema keyword `length`: {list: the key of its length, or of a list as long}."""
    for name, other in wanted.items() if isinstance(content, dict) else ():
        if isinstance(content.get(name), list | tuple):
            number = _size(content, other)
            if isinstance(number, int) and len(content[name]) != number:
                yield ValidationError(
                    f"{name} has {len(content[name])} entries; {other} asks for {number}"
                )


def _at_most(validator, wanted, content, schema):
    """Schema keyword `at_most`: {key: keys of its bounds, numbers or lists as long}."""
    for name, others in wanted.items() if isinstance(content, dict) else ():
        for other in others:
            bound = _size(content, other)
            if {type(content.get(name)), type(bound)} == {int} and content[name] > bound:
                yield ValidationError(f"{name} is {content[name]}; {other} allows at most {bound}")


def _positive_semidefinite(validator, wanted, matrix, schema):
    """Schema keyword `covariance: true`."""
    array = _array(matrix)
    if array is None:
        return
    if array.ndim != 2 or array.shape[0] != array.shape[1] or not np.array_equal(array, array.T):
        yield ValidationError("must be a symmetric matrix")
        return
    smallest = np.linalg.eigvalsh(array).min()
    if smallest < -1e-12 * max(1.0, np.abs(array).max()):
        yield ValidationError(
            f"must be positive semidefinite; its smallest eigenvalue is {smallest:.6g}"
        )


def _stochastic(validator, wanted, matrix, schema):
    """Schema keyword `stochastic: true`: a square matrix whose rows sum to one."""
    array = _array(matrix)
    if array is None:
        return
    if array.ndim != 2 or array.shape[0] != array.shape[1]:
        yield ValidationError("must be a square matrix")
    elif not np.allclose(array.sum(axis=1), 1.0, rtol=0, atol=1e-12):
        row = int(np.abs(array.sum(axis=1) - 1).argmax())
        yield ValidationError(f"each row must sum to one; row {row} sums to {array[row].sum():.6g}")


_Validator = validators.extend(
    Draft202012Validator,
    {
        "covariance": _positive_semidefinite,
        "stochastic": _stochastic,
        "rectangular": _rectangular,
        "length": _length,
        "at_most": _at_most,
    },
    type_checker=Draft202012Validator.TYPE_CHECKER.redefine_many(
        {
            "array": lambda checker, value: isinstance(value, list | tuple),
            # JSON takes 1.0 for an integer; NumPy does not.
            "integer": lambda checker, value: type(value) is int,
        }
    ),
)


@cache
def _validator(schema: Path, part: str | None):
    definition = yaml.load(schema.read_text(), Loader)
    if part is not None:
        definition = {"$defs": definition["$defs"], "$ref": f"#/$defs/{part}"}
    return _Validator(definition)


def validate(content: dict, schema: Path, where: str, part: str | None = None) -> None:
    """Check content against a schema file (or one of its `$defs`); one line for the first fault."""
    fault = best_match(_validator(schema, part).iter_errors(content))
    if fault is not None:
        place = ".".join(str(key) for key in fault.absolute_path)
        raise ParameterError(f"{where}{': ' if place else ''}{place}: {_mend(fault)}")


def _mend(fault: ValidationError) -> str:
    """A schema fault in words that say what to do."""
    wanted, value = fault.validator_value, fault.instance
    match fault.validator:
        case "required":
            missing = [key for key in wanted if key not in value]
            return f"'{missing[0]}' is missing; add it"
        case "additionalProperties":
            known = fault.schema.get("properties", {})
            unknown = [key for key in value if key not in known]
            return f"unknown key '{unknown[0]}'; known are {', '.join(known)}"
        case "minimum" | "exclusiveMinimum":
            return f"{value} is too small; the least allowed is {wanted}"
        case "maximum":
            return f"{value} is too large; the most allowed is {wanted}"
        case "enum":
            return f"'{value}' is not one of {', '.join(map(str, wanted))}"
        case "type":
            return f"{value!r} is not of type {wanted}"
    return " ".join(fault.message.split())
