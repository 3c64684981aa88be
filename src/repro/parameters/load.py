"""Parameters: every value with its source, validated, and resolved for each point of a study."""

import itertools
from pathlib import Path
from typing import NamedTuple

import yaml

from repro.parameters.validation import validate
from repro.parameters.yaml_file import ParameterError, read_yaml

# Points whose names begin so take minutes: they run only where they are asked for.
ON_REQUEST = "sensitivity-"


def on_request(point: str) -> bool:
    """Whether a point is left out of the ordinary run."""
    return point.startswith(ON_REQUEST)


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
    content = read_yaml(path)
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
    content = read_yaml(path)
    validate(content, Path(schemas) / "params.schema.yaml", str(path), part="run")
    values = _stripped(content) | overrides
    validate(values, Path(schemas) / "run.schema.yaml", f"{path} with --config")
    return values


def check_shards(studies: dict[str, dict[str, Point]], shards: int) -> None:
    """Raise ParameterError unless every point has a trial for each shard."""
    for study, points in studies.items():
        for name, point in points.items():
            if shards > point.parameters["trials"]:
                raise ParameterError(
                    f"shards: {shards} are more than the {point.parameters['trials']} trials of "
                    f"{study}, point {name}; fix params/run.yaml or --config"
                )


def sources(path: str | Path) -> list[dict]:
    """One row a value of a parameter file: where it stands, the value, its source, and why."""
    content = read_yaml(path)
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
