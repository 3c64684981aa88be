"""All sources of the site, written for Sphinx: pages, pictures, the library of the tables."""

import importlib.util
import re
import shutil
from pathlib import Path

from PIL import Image

from repro.errors import ReproError
from repro.pages.site import filter_page, gallery_pages, paper_page, scoreboard, study_page
from repro.pages.site.board import leaderboard
from repro.pages.site.content import Content
from repro.pages.site.how_to import how_to_pages
from repro.pages.site.reference import reference_pages

THUMBNAIL = 480  # px wide: twice what is shown
EXPORT = re.compile(r"export\{[^}]*?(\w+) as jQuery[^}]*\};?")


def write_sources(content: Content, folder: Path) -> None:
    """Write every page of the site as MyST into the folder, with what the pages show."""
    for page, text in _pages(content).items():
        file = folder / f"{page}.md"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    for name in ("conf.py", "style.css", "tables.js"):
        shutil.copy(content.project / "docs/site" / name, folder / name)
    _copy_pictures(content, folder / "extra")
    _write_library(folder / "static")
    for name in ("style.css", "tables.js"):
        (folder / name).rename(folder / "static" / name)


def _pages(content: Content) -> dict[str, str]:
    """Every page by its name without ending."""
    papers, studies, filters = list(content.papers), list(content.catalogue), content.filters()
    pages = {f"papers/{name}": paper_page.paper_page(content, name) for name in papers}
    pages |= {f"studies/{name}": study_page.study_page(content, name) for name in studies}
    pages |= {f"filters/{name}": filter_page.filter_page(content, name) for name in filters}
    pages |= {"leaderboard": leaderboard(content)}
    pages["papers/index"] = f"# Papers\n\n{_contents(papers)}"
    pages["studies/index"] = f"# Studies\n\n{study_page.index(content)}{_contents(studies, True)}"
    pages["filters/index"] = f"# Filters\n\n{filter_page.index(content)}{_contents(filters, True)}"
    groups = gallery_pages.groups(content)
    pages["gallery/index"] = gallery_pages.gallery_index(content) + _contents(groups, True)
    for group in groups:
        names = content.drawn(group)
        of_group = [f"{group}/{name}" for name in names]
        pages[f"gallery/{group}"] = gallery_pages.group_page(content, group) + _contents(
            of_group, True
        )
        for name in names:
            pages[f"gallery/{group}/{name}"] = gallery_pages.figure_page(content, group, name)
    how_to, reference = how_to_pages(content.project), reference_pages(content.project)
    pages |= how_to | reference
    below = [page.removeprefix("how-to/") for page in how_to if page.startswith("how-to/")]
    pages["how-to/index"] = f"# How to\n\n{_contents(below)}"
    packages = [page.removeprefix("api/") for page in reference]
    pages["api/index"] = f"# API reference\n\nFrom the docstrings.\n\n{_contents(packages)}"
    top = ["papers/index", "filters/index", "studies/index", "leaderboard", "gallery/index"]
    top += ["how-to/index", "api/index", *(["changelog"] if "changelog" in pages else [])]
    pages["index"] = scoreboard.home(content) + _contents(top, hidden=True)
    return pages


def _contents(pages: list[str], hidden: bool = False) -> str:
    """A list of contents of MyST; hidden where the page has another way to them."""
    options = ":hidden:\n" if hidden else ":maxdepth: 1\n"
    return "\n```{toctree}\n" + options + "\n" + "\n".join(pages) + "\n```\n"


def _copy_pictures(content: Content, folder: Path) -> None:
    """Pictures as they are, and thumbnails of them."""
    found = [f"{g}/{name}" for g in gallery_pages.groups(content) for name in content.drawn(g)]
    found += [
        f"studies/{study}/{kind}"
        for study in content.catalogue
        for kind in gallery_pages.STUDY_KINDS
        if (content.figures / "studies" / study / f"{kind}.png").exists()
    ]
    for name in found:
        picture, small = (folder / kind / f"{name}.png" for kind in ("pictures", "thumbnails"))
        for file in (picture, small):
            file.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(content.figures / f"{name}.png", picture)
        with Image.open(picture) as image:
            thumbnail = image.convert("RGB")
        thumbnail.thumbnail((THUMBNAIL, 4 * THUMBNAIL))
        thumbnail.save(small)


def _write_library(folder: Path) -> None:
    """DataTables, of the package itables, as a script that needs no server.

    A module cannot be read from a file system; the bundle exports its jQuery, which becomes global.
    """
    folder.mkdir(parents=True, exist_ok=True)
    found = importlib.util.find_spec("itables")
    if found is None or found.origin is None:
        raise ReproError("site: itables is missing: pip install -c constraints.txt -e '.[site]'")
    bundle = Path(found.origin).parent / "html"
    script = (bundle / "dt_bundle.js").read_text(encoding="utf-8")
    script, exports = EXPORT.subn(r"window.jQuery=\1;", script)
    if exports != 1:
        raise ReproError("site: this version of itables exports no jQuery: use constraints.txt")
    (folder / "datatables.js").write_text(f"(() => {{{script}\n}})();\n", encoding="utf-8")
    shutil.copy(bundle / "dt_bundle.css", folder / "datatables.css")
