"""A page for each filter: what it sees, its algorithm, where it runs, how it ranks, its code."""

import ast
import re
from collections.abc import Iterator
from html import escape

import pandas as pd

from repro.pages.site.content import Content
from repro.pages.site.docstring import as_markdown
from repro.pages.site.equations import files_of, steps
from repro.pages.site.fragments import link, number, raw, table, tag
from repro.pages.site.further import rows_about
from repro.pages.site.words import anchor, in_words, where_and_what
from repro.parameters.point_names import is_reading

FENCE = "`````"  # no file of this project holds five


def filter_page(content: Content, name: str) -> str:
    """The page filters/<name>.md."""
    source = (content.project / "src/repro/filters" / f"{name}.py").read_text(encoding="utf-8")
    said = ast.get_docstring(ast.parse(source)) or ""
    parts = [f"# {content.label(name)}\n", as_markdown(said), "", raw(_sees(content, name))]
    parts += ["## Algorithm\n", *_algorithm(content, name)]
    parts += ["## Where it runs, how it ranks, what it costs\n", raw(_ranks(content, name))]
    parts += [*rows_about(content, "filter", name), *_claims(content, name)]
    return "\n".join(parts)


def _sees(content: Content, name: str) -> str:
    """The channels that the filter may read, and the papers whose studies it runs on."""
    channels = content.filter_constants(name).get("SEES", ())
    seen = ", ".join(tag("code", escape(channel)) for channel in channels) or "no measurement"
    studies = content.studies_with(name)
    papers = dict.fromkeys(content.paper_of(study).name for study in studies)
    links = ", ".join(link(in_words(paper), f"../papers/{paper}.html") for paper in papers)
    channels_at = ", ".join(link(study, f"../studies/{study}.html#channels") for study in studies)
    return tag(
        "p", f"<strong>Sees</strong> {seen}; what a channel is, by study: {channels_at}."
    ) + tag(
        "p",
        f"<strong>Compared in</strong> {links}. Its module is <code>repro.filters.{name}</code>.",
    )


def _algorithm(content: Content, name: str) -> Iterator[str]:
    """Lines of code by the equations beside them, then the whole code."""
    files = files_of(name, content.project)
    found = [step for file in files for step in steps(content.project, file)]
    if found:
        cells = [
            [escape(s.equation), tag("code", escape(s.code)), f"{escape(_short(s.file))}:{s.line}"]
            for s in found
        ]
        yield "The lines of the code, and the functions, that name an equation of the paper:\n"
        yield raw(table(("equation, step", "code", "file"), cells))
    for file in files:
        text = (content.project / file).read_text(encoding="utf-8")
        yield raw(f"<details><summary>{escape(_short(file))}</summary>")
        yield f"{FENCE}python\n{text}{FENCE}\n"
        yield raw("</details>")


def _short(file: str) -> str:
    return file.removeprefix("src/repro/")


def ranks(content: Content) -> pd.DataFrame:
    """Mean rank by error over the points of each study that are no readings, and CPU time."""
    board = content.leaderboard
    board = board.loc[~board["point"].map(is_reading)]
    rank = board.groupby(["study", "point"])["error"].rank(method="min")
    board = board.assign(rank=rank)
    grouped = board.groupby(["study", "filter"], sort=False)
    summary = grouped.agg(
        points=("point", "size"),
        best=("rank", "min"),
        worst=("rank", "max"),
        mean_rank=("rank", "mean"),
        lost=("lost", "max"),
        whose=("whose", "first"),
    )
    times = content.times.loc[~content.times["point"].map(is_reading)]
    summary["cpu"] = times.groupby(["study", "filter"])["cpu_us_per_step"].median()
    size = board.groupby("study")["filter"].nunique()
    return summary.reset_index().assign(of=lambda t: t["study"].map(size))


def _ranks(content: Content, name: str) -> str:
    rows = ranks(content)
    cells = [
        [
            link(row["study"], f"../studies/{row['study']}.html"),
            number(row["points"]),
            f"{number(row['best'])} to {number(row['worst'])} of {number(row['of'])}",
            number(row["mean_rank"], 2),
            number(row["lost"], 2),
            number(row["cpu"]),
        ]
        for row in rows.loc[rows["filter"] == name].to_dict("records")
    ]
    head = ("study", "points", "rank by error", "mean rank", "largest share lost", "CPU µs a step")
    return table(head, cells)


def _claims(content: Content, name: str) -> Iterator[str]:
    """Claims one of whose comparisons names the filter."""
    named = re.compile(rf"(?<![\w]){re.escape(name)}(?![\w])")
    items = {(c["paper"], c["item"]) for c in content.comparisons if named.search(str(c["part"]))}
    rows = [row for row in content.diff if (row["paper"], row["item"]) in items]
    if rows:
        yield "## Claims that compare it\n"
        links = [
            tag("li", f"{_linked(row)}: <strong>{escape(row['verdict'])}</strong>") for row in rows
        ]
        yield raw(tag("ul", "".join(links)))


def _linked(row: dict) -> str:
    where, what = where_and_what(row)
    return link(
        f"{where}: {what}" if where else what, f"../papers/{row['paper']}.html#{anchor(row)}"
    )


def index(content: Content) -> str:
    """A table of all filters."""
    cells = [
        [
            link(content.label(name), f"{name}.html"),
            tag(
                "code",
                escape(", ".join(content.filter_constants(name).get("SEES", ())) or "nothing"),
            ),
            ", ".join(link(s, f"../studies/{s}.html") for s in content.studies_with(name)),
        ]
        for name in content.filters()
    ]
    return raw(table(("filter", "sees", "runs on"), cells, class_="sortable"))
