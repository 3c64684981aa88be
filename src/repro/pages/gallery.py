"""The gallery: every figure with its caption, paper by paper."""

from pathlib import Path

from repro.atomic import atomic_write
from repro.pages.markdown import markdown_line
from repro.workflow.code import constants


def write_gallery(scripts: list[str], titles: dict[str, str], path: str | Path) -> None:
    """Write figures/README.md; each script holds its CAPTION, and its picture is beside it."""
    text = ["# Figures", "", "Drawn by the run from the scripts beside the pictures.", ""]
    for paper, title in titles.items():
        text += [f"## {paper}", "", markdown_line(title), ""]
        for script in sorted(map(Path, scripts)):
            if script.parent.name == paper:
                caption = markdown_line(constants(str(script))["CAPTION"])
                picture = f"{paper}/{script.stem}.png"
                text += [f"![{script.stem}]({picture})", "", caption, ""]
    with atomic_write(path) as part:
        part.write_text("\n".join(text), encoding="utf-8")
