"""The lines of a filter's code that name an equation of its paper, and the code itself."""

import io
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from repro.workflow.code import code_files

EQUATION = re.compile(r"\(\d+[a-c]?\)|\b(Algorithm|Lemma|Theorem|Remark|Proposition|Prop\.) \d")
OWN = ("src/repro/filters/", "src/repro/kernels/")
EVERYWHERE = "src/repro/filters/__init__.py"


class Step(NamedTuple):
    """A line of code beside which an equation stands."""

    equation: str
    code: str
    file: str
    line: int


def files_of(filter_: str, project: Path) -> list[str]:
    """The filter's file, then those of families and kernels that name an equation."""
    own = f"src/repro/filters/{filter_}.py"
    reached = code_files(f"repro.filters.{filter_}")
    shared = [file for file in reached if file.startswith(OWN) and file not in (own, EVERYWHERE)]
    return [own, *(file for file in shared if any(steps(project, file)))]


def steps(project: Path, file: str) -> Iterator[Step]:
    """The commented lines of a file that name an equation, in their order."""
    text = (project / file).read_text(encoding="utf-8")
    lines = text.splitlines()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and EQUATION.search(token.string):
            row, column = token.start
            code = lines[row - 1][:column].strip() or next(
                (line.strip() for line in lines[row:] if not line.strip().startswith("#")), ""
            )
            yield Step(token.string.lstrip("# "), code, file, row)
