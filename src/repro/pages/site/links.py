"""Links of a built site: every target inside it must be there."""

from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

OUTSIDE = ("http", "https", "mailto", "data", "javascript")


class _Page(HTMLParser):
    """Targets and anchors of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.loaded: list[str] = []  # what a browser fetches by itself
        self.anchors: set[str] = set()

    def has(self, fragment: str) -> bool:
        """Whether there is such an anchor."""
        return unquote(fragment) in self.anchors

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value for name, value in attrs if value}
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        loads = tag in ("img", "script", "source", "iframe") or given.get("rel") in (
            *("stylesheet", "preload", "icon"),
        )
        for name in ("href", "src"):
            if name in given:
                (self.loaded if loads else self.targets).append(given[name])


def broken_links(root: Path) -> list[str]:
    """One line for each target that is not there, and each file that would come from elsewhere."""
    pages = {
        file.resolve(): _parsed(file)
        for file in sorted(root.rglob("*.html"))
        if "_static" not in file.relative_to(root).parts  # templates of the theme
    }
    return [
        f"{file.relative_to(root.resolve())}: {fault}"
        for file, page in pages.items()
        for fault in _faults(file, page, pages)
    ]


def _parsed(file: Path) -> _Page:
    page = _Page()
    page.feed(file.read_text(encoding="utf-8"))
    return page


def _faults(file: Path, page: _Page, pages: dict[Path, _Page]) -> Iterator[str]:
    for target in dict.fromkeys(page.loaded):
        scheme = urlsplit(target).scheme
        if scheme not in ("", "data") or target.startswith("//"):
            yield f"{target} would be fetched from elsewhere"
    for target in dict.fromkeys([*page.targets, *page.loaded]):
        split = urlsplit(target)
        if split.scheme in OUTSIDE or target.startswith("//"):
            continue
        there = (file.parent / unquote(split.path)).resolve() if split.path else file
        if not there.is_file():
            yield f"{target} is not there"
        elif split.fragment and there in pages and not pages[there].has(split.fragment):
            yield f"{target} has no such anchor"
