"""The gallery: thumbnails of every figure, and a page for each with caption, script and data."""

import ast
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

from repro.pages.markdown import markdown_line
from repro.pages.site.content import Content
from repro.pages.site.fragments import link, raw, tag
from repro.pages.site.words import in_words, pictures_named, where_and_what
from repro.workflow.code import constants

STUDY_KINDS = ("over_k", "over_sweep", "distribution")


def _title(content: Content, group: str, name: str) -> str:
    """The first line of a figure's script."""
    script = content.project / "figures" / group / f"{name}.py"
    said = ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or name
    return said.splitlines()[0].rstrip(".")


def groups(content: Content) -> list[str]:
    """Folders of figures with scripts: `overview`, then each paper."""
    return [group for group in ("overview", *content.papers) if content.drawn(group)]


def said(content: Content, group: str, name: str) -> dict[str, Any]:
    """CAPTION and NEEDS of a figure's script."""
    return constants(str(content.project / "figures" / group / f"{name}.py"))


def figure(content: Content, group: str, name: str, to_root: str) -> Iterator[str]:
    """A picture with its caption, if it is there."""
    if name in content.drawn(group):
        caption = str(said(content, group, name)["CAPTION"])
        yield raw(_full(f"{to_root}pictures/{group}/{name}.png", caption))
        yield f"{markdown_line(caption)}\n"


def _full(source: str, alt: str) -> str:
    picture = f'<img src="{escape(source)}" alt="{escape(alt)}" loading="lazy" class="full">'
    return tag("a", picture, href=source)


def thumbnails(content: Content, group: str, to_gallery: str, to_root: str) -> str:
    """The figures of a paper as small pictures that link to their pages."""
    shown = []
    for name in content.drawn(group):
        caption = str(said(content, group, name)["CAPTION"])
        source = f"{to_root}thumbnails/{group}/{name}.png"
        picture = f'<img src="{source}" alt="{escape(caption)}" loading="lazy">'
        text = picture + tag("span", escape(_title(content, group, name)), class_="thumbnail-name")
        target = f"{to_gallery}{group}/{name}.html"
        shown.append(tag("a", text, href=target, title=caption, class_="thumbnail"))
    return tag("div", "".join(shown), class_="thumbnails")


def gallery_index(content: Content) -> str:
    """The page gallery/index.md, without its list of contents."""
    text = [
        "# Gallery\n",
        "Every figure, drawn by the run from a script; each links to its page.\n",
    ]
    for group in groups(content):
        text += [f"## {in_words(group)}\n", raw(thumbnails(content, group, "", "../"))]
    text += ["## Every filter of every study\n", raw(_of_studies(content))]
    return "\n".join(text)


def group_page(content: Content, group: str) -> str:
    """The page gallery/<group>.md, without its list of contents."""
    title = content.papers[group].title if group in content.papers else "All papers"
    return "\n".join(
        [
            f"# {in_words(group)}\n",
            f"{markdown_line(title)}\n",
            raw(thumbnails(content, group, "", "../")),
        ]
    )


def _of_studies(content: Content) -> str:
    shown = [
        tag(
            "a",
            f'<img src="../thumbnails/studies/{study}/{kind}.png" alt="" loading="lazy">'
            + tag("span", f"{study}: {kind.replace('_', ' ')}", class_="thumbnail-name"),
            href=f"../studies/{study}.html#figures",
            class_="thumbnail",
        )
        for study in content.catalogue
        for kind in STUDY_KINDS
        if (content.figures / "studies" / study / f"{kind}.png").exists()
    ]
    return tag("div", "".join(shown), class_="thumbnails")


def figure_page(content: Content, group: str, name: str) -> str:
    """The page gallery/<group>/<name>.md: picture, caption, claims, data, script."""
    script = Path("figures", group, f"{name}.py")
    text = (content.project / script).read_text(encoding="utf-8")
    parts = [
        f"# {markdown_line(_title(content, group, name))}\n",
        *figure(content, group, name, "../../"),
    ]
    parts += [
        *_claims(content, group, name),
        "## Data\n",
        _data(content, said(content, group, name)),
    ]
    parts += ["## Draw it again\n", f"```sh\nsnakemake draw --config figure={group}/{name}\n```\n"]
    parts += [f"## Script\n\n`{script}`\n", f"`````python\n{text}`````\n"]
    return "\n".join(parts)


def _claims(content: Content, group: str, name: str) -> Iterator[str]:
    from_paper = [row for row in content.diff if row["paper"] == group and row["kind"] == "claim"]
    drawn = content.drawn(group)
    rows = [row for row in from_paper if name in pictures_named(where_and_what(row)[0], drawn)]
    if rows:
        items = [
            link(where_and_what(row)[1], f"../../papers/{group}.html#{row['item']}")
            + f": <strong>{escape(row['verdict'])}</strong>"
            for row in rows
        ]
        yield "## Claims on it\n"
        yield raw(tag("ul", "".join(tag("li", item) for item in items)))


def _data(content: Content, script: dict[str, Any]) -> str:
    """What the script says that it reads, as files of the results."""
    needs, root = script.get("NEEDS", {}), content.layout.root.name
    lines = [
        f"- `{root}/tables/{s}.csv` and `{root}/curves/{s}.csv`" for s in needs.get("tables", [])
    ]
    lines += [
        f"- runs and logs of `{study}` at {', '.join(f'`{p}`' for p in points)}"
        for study, points in needs.get("points", {}).items()
    ]
    lines += [f"- `{file}`" for file in needs.get("measured", [])]
    lines += [f"- `{root}/calibration/{name}.csv`" for name in needs.get("calibration", [])]
    lines += [f"- `{root}/leaderboard.csv`"] if needs.get("leaderboard") else []
    lines += (
        [f"- `{root}/diff.csv`, `{root}/robustness.csv`, `{root}/claims/`"]
        if needs.get("diff")
        else []
    )
    return "\n".join(lines or ["Nothing but the parameters."]) + "\n"
