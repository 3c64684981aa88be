"""The shape of a paper's parameter file: every value says where it comes from."""

from collections.abc import Iterator
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from repro.parameters.point_names import is_reading
from repro.parameters.values import Values

Text = Annotated[str, Field(min_length=1)]


class WithSource(Values):
    """A source in the paper, or `assumed` and the reason why."""

    source: Text
    why: Text | None = None

    @model_validator(mode="after")
    def _assumed_needs_a_reason(self) -> Self:
        if self.source == "assumed" and self.why is None:
            raise ValueError("'why' is missing; add it: an assumed value needs a reason")
        return self


class Sourced(WithSource):
    """A value and its source."""

    value: Any


Entries = dict[str, Sourced]


class Family(WithSource):
    """Points that differ in the swept values alone, named after them."""

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9_.={}\[\]+-]+$")]
    # Every combination of the values of these keys. A key is a parameter, or a setting written
    # filter.setting; keys joined by commas take the same value.
    sweep: dict[str, Annotated[list[Any], Field(min_length=1)]] = Field(default_factory=dict)
    set: dict[str, Any] = Field(default_factory=dict)
    filters: dict[str, dict[str, Any]] = Field(default_factory=dict)
    # Shell patterns of points above that are read anew, each as <name>@<point>; for readings only.
    of: list[Text] = Field(default_factory=list)

    @model_validator(mode="after")
    def _only_readings_are_of_points(self) -> Self:
        if self.of and not is_reading(self.name):
            raise ValueError("'of' is for readings; begin the name with reading-, or leave out of")
        return self


class Ranking(Values):
    """Which filters of a study are the paper's, and which measure them; the rest are a reader's."""

    papers: list[str] = Field(default_factory=list)  # the filters that the paper proposes
    informed: str | None = None  # the reference that knows most
    nothing: str | None = None  # the reference that uses no measurement
    others: list[str] = Field(default_factory=list)  # further filters that this project adds

    def known(self) -> set[str]:
        """All filters that are not a reader's own."""
        return {*self.papers, *self.others} | {f for f in (self.informed, self.nothing) if f}


class StudySection(Values):
    """One study of a paper."""

    parameters: Entries
    printed_trials: Sourced | None = None  # the paper's number of runs
    # Filters of this package that run on every point; for a study that has no rule of its own.
    run: list[str] = Field(default_factory=list)
    ranking: Ranking = Field(default_factory=Ranking)
    filters: dict[str, Entries] = Field(default_factory=dict)
    analysis: Entries = Field(default_factory=dict)  # thresholds of the metrics and claims
    # Points at which filters' own covariances are judged, and why there.
    consistency: dict[str, Text] = Field(default_factory=dict)
    points: Annotated[list[Family], Field(min_length=1)]


class PaperFile(Values):
    """The whole file."""

    paper: Text
    title: Text = "a study of one's own"
    authors: Text = "not published"
    studies: dict[str, StudySection]
    examples: dict[str, Entries] = Field(default_factory=dict)
    # Box and effort of the search for what was fitted to the paper's numbers.
    calibration: Entries = Field(default_factory=dict)


class RunFile(Values):
    """What holds for every study: params/run.yaml."""

    root_seed: Sourced
    shards: Sourced
    tolerance: Sourced


def plain(entries: Entries) -> dict[str, Any]:
    """The values without their sources."""
    return {name: entry.value for name, entry in entries.items()}


def every_value(content: PaperFile) -> Iterator[tuple[str, str, str, Any, WithSource]]:
    """(study, point, name, value, source) of every value of a file, in its order."""
    for study, section in content.studies.items():
        for name, entry in section.parameters.items():
            yield study, "every", name, entry.value, entry
        if section.printed_trials is not None:
            printed = section.printed_trials
            yield study, "every", "printed_trials", printed.value, printed
        for filter_, settings in section.filters.items():
            for name, entry in settings.items():
                yield study, "every", f"{filter_}.{name}", entry.value, entry
        for name, entry in section.analysis.items():
            yield study, "analysis", name, entry.value, entry
        for family in section.points:
            changes = family.sweep | family.set
            for filter_, settings in family.filters.items():
                changes |= {f"{filter_}.{name}": value for name, value in settings.items()}
            for name, value in changes.items():
                yield study, family.name, name, value, family
    for example, entries in content.examples.items():
        for name, entry in entries.items():
            yield example, "every", name, entry.value, entry
    for name, entry in content.calibration.items():
        yield "calibration", "every", name, entry.value, entry
