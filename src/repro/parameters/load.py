"""Parameters: every value with its source, validated, and resolved for each point of a study."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import yaml
from pydantic import Field

from repro import plugins
from repro.parameters.families import Resolved, resolved
from repro.parameters.paper_file import (
    PaperFile,
    Ranking,
    RunFile,
    StudySection,
    every_value,
    plain,
)
from repro.parameters.point_names import is_plain, on_request, own_table
from repro.parameters.settings import assumed_parameters, checked_settings
from repro.parameters.values import ParameterError, PointParameters, Positive, Values
from repro.parameters.yaml_file import check_plain, parsed, read_yaml

SMOKE_STEPS = 300  # the quadrotor alone has more


class Point(NamedTuple):
    """The values of one point of a study, sources stripped."""

    parameters: PointParameters  # of the study's own type
    filters: dict[str, dict[str, Any]]  # settings by filter, as JSON has them
    family: str  # name of the family that the point belongs to
    swept: dict[str, Any]  # the values that tell it from the others of its family

    def with_trials(self, trials: int) -> "Point":
        """The same point with another number of trials."""
        return self._replace(parameters=self.parameters.model_copy(update={"trials": trials}))

    def shortened(self) -> "Point":
        """The same point with as few steps as a smoke run has."""
        steps = min(self.parameters.steps, SMOKE_STEPS)
        return self._replace(parameters=self.parameters.model_copy(update={"steps": steps}))


class Paper(NamedTuple):
    """One paper's parameters."""

    name: str
    title: str
    authors: str
    studies: dict[str, dict[str, Point]]  # study -> point -> values
    analysis: dict[str, dict[str, Any]]  # study -> thresholds of its metrics and claims
    ranking: dict[str, Ranking]  # study -> whose its filters are
    consistency: dict[str, dict[str, str]]  # study -> points where covariances are judged: why
    printed_trials: dict[str, int | None]  # study -> the paper's number of runs
    run: dict[str, list[str]]  # study -> filters that run on every point without a rule
    examples: dict[str, dict[str, Any]]
    calibration: dict[str, Any]  # box and effort of the search for what was fitted

    def described(self, study: str) -> dict[str, Any]:
        """What jobs get to know of a study besides its files: plain values."""
        return {
            "paper": self.name,
            "authors": self.authors,
            "analysis": self.analysis[study],
            "ranking": self.ranking[study].plain(),
            "consistency": self.consistency[study],
            "points": {
                name: {"family": point.family, "swept": point.swept}
                for name, point in self.studies[study].items()
            },
        }


SEEDS = r"^[0-9]+( +[0-9]+)*$"


class Run(Values):
    """What holds for every study, with what --config may add."""

    root_seed: Annotated[int, Field(ge=0, description="seed of every random stream")]
    shards: Annotated[
        int,
        Field(ge=1, le=1000, description="jobs that the trials of a point are split into"),
    ]
    tolerance: Annotated[Positive, Field(description="standard errors that decide a verdict")]
    trials: Annotated[int, Field(ge=1, description="trials of every point")] | None = None
    into: Annotated[
        str, Field(pattern=r"^[A-Za-z0-9_./-]+$", description="folder of results and figures")
    ] = "."
    one_point_per_family: Annotated[
        bool, Field(description="whether only the first point of each family runs, and no claim")
    ] = False
    log: Annotated[str, Field(description="MCAP file recorded elsewhere")] | None = None
    study: Annotated[str, Field(description="study that the log is of")] | None = None
    point: Annotated[str, Field(description="point that the log is of")] | None = None
    parameters: (
        Annotated[
            str | dict[str, Any],
            Field(description="values of the log's own, or a YAML file of them"),
        ]
        | None
    ) = None
    seeds: (
        Annotated[str, Field(pattern=SEEDS, description="root seeds to run anew")]
        | Annotated[int, Field(ge=0, description="the only one")]
        | None
    ) = None
    budget: Annotated[
        Positive, Field(description="effort of `calibration`, as a share of the parameter files'")
    ] = 1.0
    figure: Annotated[str, Field(description="figure to draw, as PAPER/FIGURE")] | None = None
    filter: Annotated[str, Field(description="filter that the leaderboard is asked for")] | None = (
        None
    )


def first_of_families(points: Mapping[str, Point]) -> list[str]:
    """The first point of each family of the paper's own points."""
    first: dict[str, str] = {}
    for name, point in points.items():
        if is_plain(name):
            first.setdefault(point.family, name)
    return list(first.values())


def whose_logs(points: Mapping[str, Point]) -> dict[str, str]:
    """The point whose log each point reads: the first that is simulated with the same values.

    Points that differ in the settings of filters alone share one log. A point on request lends its
    log to others on request only, for an ordinary run does not simulate it; one of a table of its
    own lends it to others of such tables only.
    """
    first: dict[str, str] = {}  # by the values
    return {
        name: first.setdefault(json.dumps(points[name].parameters.plain(), sort_keys=True), name)
        for name in sorted(points, key=lambda point: (on_request(point), bool(own_table(point))))
    }


def load_paper(path: str | Path) -> Paper:
    """Read, validate and resolve one paper's YAML. Raises ParameterError, in one line."""
    content = PaperFile.checked(read_yaml(path), str(path))
    studies: dict[str, dict[str, Point]] = {}
    analysis = {}
    for name, section in content.studies.items():
        where = f"{path}: studies.{name}"
        try:
            study = plugins.study(name)
        except plugins.ReproError as error:
            raise ParameterError(f"{where}: {error}") from None
        thresholds = study.Analysis.checked(plain(section.analysis), f"{where}.analysis")
        analysis[name] = thresholds.plain()
        studies[name] = {}
        found: dict[str, Resolved] = {}
        for family in section.points:
            for point in resolved(section, family, found, where):
                here = f"{where}.points.{point.name}"
                if point.name in found:
                    raise ParameterError(f"{here}: two points have this name; rename one")
                found[point.name] = point
                settings = point.filters.items()
                for filter_, values in settings:
                    if assumed := assumed_parameters(values):
                        wrong = f"{here}: filters.{filter_}: assumed values"
                        study.Parameters.checked(point.parameters | assumed, wrong)
                studies[name][point.name] = Point(
                    study.Parameters.checked(point.parameters, f"{here}: parameters"),
                    {f: checked_settings(f, s, f"{here}: filters.{f}") for f, s in settings},
                    point.family,
                    point.swept,
                )
        for point in section.consistency.keys() - found.keys():
            raise ParameterError(f"{where}.consistency: there is no point {point}; name one of it")
    examples = {name: plain(entries) for name, entries in content.examples.items()}
    return Paper(
        content.paper,
        content.title,
        content.authors,
        studies,
        analysis,
        {name: section.ranking for name, section in content.studies.items()},
        {name: section.consistency for name, section in content.studies.items()},
        {name: _printed(section, analysis[name]) for name, section in content.studies.items()},
        {name: section.run for name, section in content.studies.items()},
        examples,
        plain(content.calibration),
    )


def _printed(section: StudySection, analysis: dict[str, Any]) -> int | None:
    """The paper's number of runs, which may be a threshold of its study as well."""
    printed = section.printed_trials
    return analysis.get("printed_trials") if printed is None else printed.value


def load_run(path: str | Path, overrides: dict[str, Any]) -> Run:
    """What holds for every study, with `--config` overrides (trials, shards, into ...)."""
    values = plain(dict(RunFile.checked(read_yaml(path), str(path))))
    where = f"{path} with --config"
    check_plain(overrides, where)
    return Run.checked(values | overrides, where)


def user_values(given: str | dict[str, Any] | None) -> tuple[dict[str, Any], str]:
    """Values that replace a point's, given on the spot or as a YAML file, and where they are."""
    if isinstance(given, str):
        return read_yaml(given), given
    where = "--config: parameters"
    values = {name: _read_again(value) for name, value in (given or {}).items()}
    check_plain(values, where)
    return values, where


def _read_again(value: Any) -> Any:
    """A value inside a mapping of --config, whose numbers Snakemake leaves as strings."""
    if isinstance(value, list):
        return [_read_again(entry) for entry in value]
    if not isinstance(value, str):
        return value
    try:
        return parsed(value, "--config: parameters")
    except (yaml.YAMLError, ValueError):
        return value


def check_shards(studies: dict[str, dict[str, Point]], shards: int) -> None:
    """Raise ParameterError unless every point has a trial for each shard."""
    for study, points in studies.items():
        for name, point in points.items():
            if shards > point.parameters.trials:
                raise ParameterError(
                    f"shards: {shards} are more than the {point.parameters.trials} trials of "
                    f"{study}, point {name}; fix params/run.yaml or --config"
                )


def sources(path: str | Path) -> list[dict[str, str]]:
    """Every value of a parameter file, a row each: its place, the value, its source, and why."""
    content = PaperFile.checked(read_yaml(path), str(path))
    return [
        {
            "paper": content.paper,
            "study": study,
            "point": point,
            "parameter": name,
            "value": yaml.safe_dump(value, default_flow_style=True).removesuffix("\n...\n").strip(),
            "source": origin.source,
            "why": origin.why or "",
        }
        for study, point, name, value, origin in every_value(content)
    ]
