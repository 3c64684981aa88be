"""The pages of docs/ and the other texts of the project, with links that hold on the site."""

import re
from pathlib import Path, PurePosixPath

LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#\s]+)(#[^)\s]*)?\)")
# Texts outside docs/ -> their page.
OTHERS = {
    "CONTRIBUTING.md": "how-to/contributing",
    "params/README.md": "how-to/parameter-files",
    "CHANGELOG.md": "changelog",
}


def how_to_pages(project: Path) -> dict[str, str]:
    """Text of each page, by its name on the site without ending."""
    named = {
        f"docs/{file.name}": f"how-to/{file.stem}" for file in sorted(project.glob("docs/*.md"))
    }
    named |= {name: page for name, page in OTHERS.items() if (project / name).exists()}
    return {
        page: _linked((project / name).read_text(encoding="utf-8"), name, page, named)
        for name, page in named.items()
    }


def _linked(text: str, name: str, page: str, named: dict[str, str]) -> str:
    """A text whose links to other texts lead to their pages; links to files become their names."""

    def replaced(match: re.Match[str]) -> str:
        picture, shown, target, part = match.groups()
        if "://" in target:
            return match[0]
        there = _normal(PurePosixPath(name).parent / target)
        if there in named and not picture:
            up = "../" * page.count("/")
            return f"[{shown}]({up}{named[there]}.md{part or ''})"
        return f"{shown} (`{there}`)" if shown != there else f"`{there}`"

    return LINK.sub(replaced, text)


def _normal(path: PurePosixPath) -> str:
    """A path without its steps up."""
    parts: list[str] = []
    for part in path.parts:
        if part == "..":
            parts = parts[:-1]
        else:
            parts.append(part)
    return "/".join(parts)
