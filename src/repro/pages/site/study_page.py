"""A page for each study: ranking, parameters with sources and units, channels, a filter on it."""

import inspect
from collections.abc import Iterator
from html import escape

from repro import plugins
from repro.pages.leaderboard import summarised
from repro.pages.log_topics import topics_of_study
from repro.pages.parameter_reference import meanings
from repro.pages.site.content import Content
from repro.pages.site.docstring import as_markdown
from repro.pages.site.fragments import details, link, number, raw, table, tag
from repro.pages.site.further import rows_about
from repro.pages.site.gallery_pages import STUDY_KINDS
from repro.pages.site.words import in_words
from repro.parameters.point_names import is_reading
from repro.studies import ClosedLoop

LONGEST = 80  # characters of a value; longer ones are cut
RUN_A_FILTER = """\
Write `src/repro/filters/mine.py` ([a worked example](../how-to/add-a-filter.md)) and a rule in
`workflow/rules/filters.smk`:

```python
use rule run_filter as mine with:
    output:
        runs("mine", studies=["{study}"]),
```

```sh
snakemake leaderboard --config filter=mine study={study} trials=100   # ranks it in seconds
snakemake -j2                                                         # and in the whole run
```
"""


def study_page(content: Content, name: str) -> str:
    """The page studies/<name>.md."""
    study, paper = plugins.study(name), content.paper_of(name)
    of_paper = link(in_words(paper.name), f"../papers/{paper.name}.html")
    parts = [f"# {name}\n", as_markdown(inspect.getdoc(type(study)) or ""), ""]
    parts += [raw(tag("p", f"A study of {of_paper}: {escape(paper.title)}."))]
    parts += ["## Ranking\n", raw(_ranking(content, name)), "## Figures\n"]
    parts += [raw(_pictures(content, name)), "## Parameters\n", raw(_parameters(content, name))]
    parts += ["## Points\n", raw(_points(content, name)), "## Channels\n"]
    parts += [_channels(content, name), "## Run a filter of your own on it\n"]
    parts += [RUN_A_FILTER.format(study=name), *rows_about(content, "study", name)]
    return "\n".join(parts)


def _ranking(content: Content, name: str) -> str:
    board = summarised(content.leaderboard.loc[content.leaderboard["study"] == name])
    board = board.loc[~board["family"].map(is_reading)]
    cells = [
        [
            escape(row["family"]),
            link(content.label(row["filter"]), f"../filters/{row['filter']}.html"),
            escape(row["whose"]),
            number(row["error"]),
            number(row["median run"]),
            number(row["of informed"]),
            number(row["lost"], 2),
        ]
        for row in board.to_dict("records")
    ]
    unit = plugins.study(name).error_unit
    error = f"error, {unit}" if unit else "error"
    head = ("points", "filter", "whose", error, "median run", "of informed", "lost")
    return table(head, cells, class_="sortable", data_menus="0")


def _pictures(content: Content, name: str) -> str:
    shown = []
    for kind in STUDY_KINDS:
        source = f"pictures/studies/{name}/{kind}.png"
        if (content.figures / "studies" / name / f"{kind}.png").exists():
            alt = f"{name}: {kind.replace('_', ' ')}"
            shown.append(f'<img src="../{source}" alt="{alt}" loading="lazy" class="full">')
    return "".join(shown) or "<p>none drawn</p>"


def _parameters(content: Content, name: str) -> str:
    """Values that hold at every point, with unit and source."""
    study = plugins.study(name)
    known = {**meanings(study.Parameters), **meanings(study.Analysis)}
    rows = [r for r in content.parameters if r["study"] == name]
    cells = [
        [
            tag("code", escape(r["parameter"])),
            tag("code", escape(_shortened(r["value"]))),
            escape(known.get(r["parameter"], "")),
            escape(r["source"]) + (f": {escape(r['why'])}" if r["why"] else ""),
        ]
        for r in rows
        if r["point"] in ("every", "analysis")
    ]
    return table(("parameter", "value", "meaning and unit", "source"), cells, class_="sortable")


def _points(content: Content, name: str) -> str:
    """Points that are no readings, with the number of readings beside them."""
    points = content.paper_of(name).studies[name]
    plain = {point: at for point, at in points.items() if not is_reading(point)}
    cells = [
        [
            tag("code", escape(point)),
            number(at.parameters.trials),
            number(at.parameters.steps),
            ", ".join(content.label(f) for f in content.catalogue[name].get(point, [])),
        ]
        for point, at in plain.items()
    ]
    others = f"{len(points) - len(plain)} more points are other readings of the paper."
    shown = table(("point", "trials", "steps", "filters"), cells)
    return details(f"{len(plain)} points", shown) + tag("p", others)


def _channels(content: Content, name: str) -> str:
    points = content.paper_of(name).studies[name]
    found = list(topics_of_study(name, {p: point.parameters for p, point in points.items()}))
    if found:
        return "\n".join(_without_heading(found)) + "\n"
    if isinstance(plugins.study(name), ClosedLoop):
        return "The estimate steers the plant, so each filter has a log of its own.\n"
    return "Every channel is made of all topics of the log but the truth.\n"


def _without_heading(lines: list[str]) -> Iterator[str]:
    yield from (line for line in lines if not line.startswith("### "))


def _shortened(value: str) -> str:
    return value if len(value) < LONGEST else f"{value[: LONGEST - 3]}..."


def index(content: Content) -> str:
    """A table of all studies."""
    cells = [
        [
            link(name, f"{name}.html"),
            link(
                in_words(content.paper_of(name).name),
                f"../papers/{content.paper_of(name).name}.html",
            ),
            escape((inspect.getdoc(type(plugins.study(name))) or "").splitlines()[0]),
        ]
        for name in content.catalogue
    ]
    return raw(table(("study", "paper", "what it is"), cells))
