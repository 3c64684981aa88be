"""Build the site: its sources, Sphinx, and a check of all links inside it."""

import importlib.util
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from repro.errors import ReproError
from repro.layout import Catalogue
from repro.pages.site.content import Content, read_content
from repro.pages.site.links import broken_links
from repro.pages.site.sources import write_sources

NEEDED = ("sphinx", "myst_parser", "pydata_sphinx_theme", "itables")
MOST = 60  # lines of a message


def build_site(
    root: str | Path, catalogue: Catalogue, project: str | Path, figures: str | Path, index: str
) -> None:
    """Build the site of the results under `root`; `index` is its first page, in its own folder.

    Raises ReproError if a package is missing, if Sphinx warns, or if a link leads nowhere.
    """
    missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if missing:
        raise ReproError(
            f"site: {', '.join(missing)} missing: pip install -c constraints.txt -e '.[site]'"
        )
    content = read_content(root, catalogue, project, figures)
    into = Path(index).parent
    with tempfile.TemporaryDirectory() as folder:
        built = _built(content, Path(folder))
        shutil.rmtree(into, ignore_errors=True)
        shutil.copytree(built, into)


def _built(content: Content, folder: Path) -> Path:
    source, built = folder / "source", folder / "html"
    source.mkdir()
    write_sources(content, source)
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html"]
    command += ["-d", str(folder / "doctrees"), str(source), str(built)]
    answer = subprocess.run(command, capture_output=True, text=True)
    if answer.returncode != 0:
        raise _fault("Sphinx warns", answer.stderr.replace(str(source), "").splitlines())
    broken = broken_links(built)
    if broken:
        raise _fault("links lead nowhere", broken)
    return built


def _fault(what: str, lines: list[str]) -> ReproError:
    """An error in one line, with its first lines as details."""
    error = ReproError(f"site: {what}: {len(lines)} lines, of which the first: {lines[0]}")
    error.details = "\n".join(lines[:MOST]) + "\n"
    return error
