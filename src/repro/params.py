"""Parameters: every value with its source, validated, and resolved for each point of a study."""

import itertools
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import yaml
from jsonschema import Draft202012Validator, ValidationError, validators
from jsonschema.exceptions import best_match

from repro.errors import ReproError

Loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)  # the same language, ten times faster


class ParameterError(ReproError):
    """A parameter file that says something it must not, or lacks something it must say."""


class Point(NamedTuple):
    """The plain values of one point of a study, sources stripped."""

    parameters: dict
    filters: dict[str, dict]  # settings by filter


class Paper(NamedTuple):
    name: str
    title: str
    authors: str
    studies: dict[str, dict[str, Point]]  # study -> point -> values
    examples: dict[str, dict]


def load_paper(path: str | Path, schemas: str | Path) -> Paper:
    """Read, validate and resolve one paper's YAML. Raises ParameterError, in one line."""
    content = _load(path)
    validate(content, Path(schemas) / "params.schema.yaml", str(path))
    studies = {}
    for name, study in content["studies"].items():
        schema = Path(schemas) / f"{name}.schema.yaml"
        if not schema.exists():
            raise ParameterError(f"{path}: studies.{name}: no such study; add {schema}")
        studies[name] = {}
        for family in study["points"]:
            for point, values in _resolved(study, family, f"{path}: studies.{name}"):
                where = f"{path}: studies.{name}.points.{point}"
                if point in studies[name]:
                    raise ParameterError(f"{where}: two points have this name; rename one")
                validate(values._asdict(), schema, where)
                studies[name][point] = values
    examples = {name: _stripped(values) for name, values in content.get("examples", {}).items()}
    return Paper(content["paper"], content["title"], content["authors"], studies, examples)


def load_run(path: str | Path, schemas: str | Path, overrides: dict) -> dict:
    """What holds for every study, with `--config` overrides (trials, shards, into)."""
    content = _load(path)
    validate(content, Path(schemas) / "params.schema.yaml", str(path), part="run")
    values = _stripped(content) | overrides
    validate(values, Path(schemas) / "run.schema.yaml", f"{path} with --config")
    return values


def sources(path: str | Path) -> list[dict]:
    """One row a value of a parameter file: where it stands, the value, its source, and why."""
    content = _load(path)
    rows = []

    def add(study, point, name, entry):
        rows.append(
            {
                "paper": content["paper"],
                "study": study,
                "point": point,
                "parameter": name,
                "value": yaml.safe_dump(entry["value"], default_flow_style=True)
                .removesuffix("\n...\n")
                .strip(),
                "source": entry["source"],
                "why": entry.get("why", ""),
            }
        )

    for study, values in content["studies"].items():
        for name, entry in values["parameters"].items():
            add(study, "every", name, entry)
        for filter_, settings in values.get("filters", {}).items():
            for name, entry in settings.items():
                add(study, "every", f"{filter_}.{name}", entry)
        for family in values["points"]:
            said = {"source": family["source"], "why": family.get("why", "")}
            changes = family.get("sweep", {}) | family.get("set", {})
            for filter_, settings in family.get("filters", {}).items():
                changes |= {f"{filter_}.{name}": value for name, value in settings.items()}
            for name, value in changes.items():
                add(study, family["name"], name, said | {"value": value})
    for example, values in content.get("examples", {}).items():
        for name, entry in values.items():
            add(example, "every", name, entry)
    return rows


def _load(path: str | Path) -> dict:
    try:
        content = yaml.load(Path(path).read_text(), Loader)
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ParameterError(f"{path}: not YAML: {' '.join(str(error).split())}") from None
    if not isinstance(content, dict):
        raise ParameterError(f"{path}: not a mapping of keys to values")
    return content


def _stripped(entries: dict) -> dict:
    return {name: entry["value"] for name, entry in entries.items()}


def _resolved(study: dict, family: dict, where: str):
    """Name and values of each point of a family: base values, then `set`, then the sweep."""
    base = _stripped(study["parameters"]) | family.get("set", {})
    filters = {name: _stripped(values) for name, values in study.get("filters", {}).items()}
    for name, settings in family.get("filters", {}).items():
        if name not in filters:
            raise ParameterError(f"{where}: {family['name']}: no settings of a filter '{name}'")
        filters[name] = filters[name] | settings
    sweep = family.get("sweep", {})
    for values in itertools.product(*sweep.values()):
        parameters = base | dict(zip(sweep, values, strict=True))
        try:
            point = family["name"].format(**parameters)
        except (KeyError, IndexError, ValueError, AttributeError) as error:
            raise ParameterError(
                f"{where}: point name '{family['name']}' names no parameter: {error}"
            ) from None
        yield point, Point(parameters, filters)


def _positive_semidefinite(validator, wanted, matrix, schema):
    """Schema keyword `covariance: true`."""
    try:
        array = np.array(matrix, dtype=float)
    except (TypeError, ValueError):
        return  # the type is reported by its own keyword
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
    try:
        array = np.array(matrix, dtype=float)
    except (TypeError, ValueError):
        return  # the type is reported by its own keyword
    if array.ndim != 2 or array.shape[0] != array.shape[1]:
        yield ValidationError("must be a square matrix")
    elif not np.allclose(array.sum(axis=1), 1.0, rtol=0, atol=1e-12):
        row = int(np.abs(array.sum(axis=1) - 1).argmax())
        yield ValidationError(f"each row must sum to one; row {row} sums to {array[row].sum():.6g}")


_Validator = validators.extend(
    Draft202012Validator,
    {"covariance": _positive_semidefinite, "stochastic": _stochastic},
    type_checker=Draft202012Validator.TYPE_CHECKER.redefine(
        "array", lambda checker, value: isinstance(value, list | tuple)
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
