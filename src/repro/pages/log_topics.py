"""What a log of each study needs, channel by channel, for docs/your-own-log.md.

python -m repro.pages.log_topics
"""

from collections.abc import Iterator
from pathlib import Path

from repro import plugins
from repro.parameters.load import load_paper
from repro.parameters.values import PointParameters
from repro.studies import ClosedLoop, Fields, Integers

SHOWN = 6  # fields of a topic, before the rest is left out


def log_topics(params: str | Path = "params") -> str:
    """Tables of topics and fields of every open-loop study, in Markdown.

    As at its first point; other points have a row where a channel is of other topics.
    """
    sections = []
    for file in sorted(Path(params).glob("*.yaml")):
        if file.name != "run.yaml":
            for name, points in load_paper(file).studies.items():
                sections += topics_of_study(name, {p: at.parameters for p, at in points.items()})
    return "\n".join(sections)


def topics_of_study(name: str, points: dict[str, PointParameters]) -> Iterator[str]:
    """The section of a study, given its points; nothing for a closed loop."""
    study, first = plugins.study(name), next(iter(points))
    if isinstance(study, ClosedLoop) or study.channel_topics(points[first]) is None:
        return
    yield f"### `{name}`, at `{first}`\n"
    if study.log_remark:
        yield f"{study.log_remark[0].upper()}{study.log_remark[1:]}.\n"
    yield "| channel | topics and their fields |\n|---|---|"
    listed = set()  # channels with their topics
    for point, parameters in points.items():
        rows: dict[str, list[str]] = {}  # channels by what they are made of
        for channel, fields in (study.channel_topics(parameters) or {}).items():
            if (channel, *fields) not in listed:
                listed.add((channel, *fields))
                of = _fields(fields, study.integers(parameters)) or "nothing"
                rows.setdefault(of, []).append(f"`{channel}`")
        where = "" if point == first else f", at `{point}`"
        for of, channels in rows.items():
            yield f"| {', '.join(channels)}{where} | {of} |"
    truth = {"/truth": study.topics(points[first])["/truth"]}
    yield f"| the truth, for errors | {_fields(truth, {})} |\n"
    if study.constant_topics:
        names = ", ".join(f"`{topic}`" for topic in study.constant_topics)
        yield f"One message a trial: {names}.\n"


def _fields(topics: Fields, integers: Integers) -> str:
    return "; ".join(
        f"`{topic}`: {_names(names, integers.get(topic, {}))}" for topic, names in topics.items()
    )


def _names(names: tuple[str, ...], bounds: dict[str, tuple[int, int]]) -> str:
    """The fields of a topic, the first and the last of many, and the bounds of integers."""
    shown = [f"`{name}`{_bounds(bounds.get(name))}" for name in names]
    if len(names) > SHOWN:
        shown = [*shown[:3], "...", f"{shown[-1]} ({len(names)} fields)"]
    return ", ".join(shown)


def _bounds(bounds: tuple[int, int] | None) -> str:
    return "" if bounds is None else f" (integer, {bounds[0]} to {bounds[1]})"


if __name__ == "__main__":
    print(log_topics())
