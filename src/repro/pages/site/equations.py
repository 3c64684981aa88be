"""The lines of a filter's code that name an equation of its paper, and the code itself."""

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from repro.workflow.code import code_files

# (22), but neither x(0) nor a year.
EQUATION = re.compile(r"(?<!\w)\(\d{1,2}[a-c]?\)|\b(Algorithm|Lemma|Theorem|Remark|[Ss]tep) \d")
OWN = ("src/repro/filters/", "src/repro/kernels/")
EVERYWHERE = "src/repro/filters/__init__.py"


class Step(NamedTuple):
    """A line of code, or a function, that an equation is named for."""

    equation: str
    code: str
    file: str
    line: int


def files_of(filter_: str, project: Path) -> list[str]:
    """The filter's file, then those of families and kernels that name an equation."""
    own = f"src/repro/filters/{filter_}.py"
    reached = code_files(f"repro.filters.{filter_}")
    shared = [file for file in reached if file.startswith(OWN) and file not in (own, EVERYWHERE)]
    return [own, *(file for file in shared if steps(project, file))]


def steps(project: Path, file: str) -> list[Step]:
    """The commented lines and the functions of a file that name an equation, in their order."""
    text = (project / file).read_text(encoding="utf-8")
    found = [*_lines(text, file), *_functions(text, file)]
    return sorted(found, key=lambda step: step.line)


def _lines(text: str, file: str) -> Iterator[Step]:
    lines = text.splitlines()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and EQUATION.search(token.string):
            row, column = token.start
            below = (line.strip() for line in lines[row:] if not line.strip().startswith("#"))
            code = lines[row - 1][:column].strip() or next(below, "")
            yield Step(token.string.lstrip("# "), code, file, row)


def _functions(text: str, file: str) -> Iterator[Step]:
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            said = (ast.get_docstring(node) or "").partition("\n")[0]
            if EQUATION.search(said):
                yield Step(said, f"def {node.name}", file, node.lineno)
