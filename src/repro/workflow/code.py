"""The source files that a job depends on: modules of this package that its imports reach."""

import ast
import re
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from repro.errors import ReproError

# Of this package alone. Parsing the files took a tenth of the time that Snakemake takes to start.
IMPORT = re.compile(r"^ *(?:from|import) +(repro[\w.]*)(?: +import +(\([^)]*\)|.*))?", re.MULTILINE)
NAME = re.compile(r"\b(\w+)\b(?: +as +\w+)?")

SOURCE = Path(__file__).resolve().parents[2]
PROJECT = SOURCE.parent
SOURCES = (".py", ".smk", ".yaml", ".csv")


@cache
def code_files(*starts: str) -> list[str]:
    """Files that the given modules (dotted names) or scripts (paths ending in .py) reach.

    Paths are relative to the folder that holds src/, sorted; a script itself is not listed.
    Raises ReproError for a module or script that does not exist.
    """
    reached: set[str] = set()
    todo: list[str] = []
    for start in starts:
        if start.endswith(".py"):
            if not Path(start).exists():
                raise ReproError(f"code(): there is no script {start}")
            todo += _imported(start)
        else:
            files = _module_files(start)
            if not files:
                raise ReproError(f"code(): there is no module {start} in {SOURCE.name}/")
            todo += files
    while todo:
        file = todo.pop()
        if file not in reached:
            reached.add(file)
            todo += _imported(PROJECT / file)
    return sorted(reached)


@cache
def code_digest(*starts: str) -> str:
    """Digest of the reached files: an edit changes it, a new time stamp does not."""
    digests = [f"{file} {_digest(file)}" for file in code_files(*starts)]
    return sha256("\n".join(digests).encode()).hexdigest()


def source_digest() -> str:
    """Digest of all that decides a result: code, rules, figures, parameters."""
    folders = ("src", "workflow", "figures", "params")
    found = [PROJECT / "Snakefile"]
    for folder in folders:
        found += [p for p in PROJECT.joinpath(folder).rglob("*") if p.suffix in SOURCES]
    files = sorted(str(path.relative_to(PROJECT)) for path in found)
    return sha256("\n".join(f"{file} {_digest(file)}" for file in files).encode()).hexdigest()


@cache
def _digest(file: str) -> str:
    return sha256((PROJECT / file).read_bytes()).hexdigest()


@cache
def _module_files(module: str) -> list[str]:
    """Files of a module and of the packages above it; none if it is not of this package."""
    if module.split(".")[0] != "repro":
        return []
    package = module.rpartition(".")[0]
    above = _module_files(package) if package else []
    for candidate in (f"{module.replace('.', '/')}.py", f"{module.replace('.', '/')}/__init__.py"):
        if (SOURCE / candidate).exists():
            return [*above, f"{SOURCE.name}/{candidate}"]
    return []


@cache
def _imported(file: str | Path) -> list[str]:
    """Files of the modules that a file imports, each once."""
    files: dict[str, None] = {}
    for module, names in IMPORT.findall(Path(file).read_text(encoding="utf-8")):
        files |= dict.fromkeys(_module_files(module))
        for name in NAME.findall(names):
            files |= dict.fromkeys(_module_files(f"{module}.{name}"))
    return list(files)


@cache
def constants(script: str) -> dict[str, Any]:
    """Literal constants at the top of a script, read without running it."""
    values = {}
    for node in ast.parse(Path(script).read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            try:
                values[node.targets[0].id] = ast.literal_eval(node.value)
            except ValueError:
                continue
    return values
