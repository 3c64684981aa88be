"""The API reference: every public class and function with its docstring, from the source alone.

The source is parsed and not imported: compiled kernels are no functions to `autodoc`, and
docstrings are Markdown here.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

from repro.pages.site.docstring import as_markdown

FENCE = ":::::"
Definition = ast.FunctionDef | ast.ClassDef


def reference_pages(project: Path) -> dict[str, str]:
    """A page for each package of src/repro, by its name: api/<package>."""
    source = project / "src/repro"
    modules: dict[str, list[Path]] = {}
    for file in sorted(source.rglob("*.py")):
        parts = file.relative_to(source).parts
        # Loose modules are those of the Python interface and of what all share.
        modules.setdefault(parts[0] if len(parts) > 1 else "repro", []).append(file)
    return {
        f"api/{package}": "\n".join(_page(package, files, source))
        for package, files in modules.items()
    }


def _page(package: str, files: list[Path], source: Path) -> Iterator[str]:
    yield f"# {'repro' if package == 'repro' else f'repro.{package}'}\n"
    for file in files:
        yield from _module(file, source)


def _module(file: Path, source: Path) -> Iterator[str]:
    parts = file.relative_to(source.parent).with_suffix("").parts
    name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
    tree = ast.parse(file.read_text(encoding="utf-8"))
    said = ast.get_docstring(tree)
    members = list(_public(tree.body))
    if not said and not members:
        return
    if name != "repro" and name.count(".") > 1:
        yield f"## {name}\n"
    yield f"```{{py:module}} {name}\n```\n"
    yield f"{as_markdown(said or '')}\n"
    for member in members:
        yield from _member(member, FENCE)


def _public(body: list[ast.stmt]) -> Iterator[Definition]:
    for node in body:
        if isinstance(node, Definition) and not node.name.startswith("_"):
            yield node


def _member(node: Definition, fence: str) -> Iterator[str]:
    said = as_markdown(ast.get_docstring(node) or "")
    if isinstance(node, ast.FunctionDef):
        yield f"{fence}{{py:{'function' if fence == FENCE else 'method'}}} {signature(node)}"
        yield f"\n{said}\n{fence}\n"
        return
    yield f"{fence}{{py:class}} {node.name}\n\n{said}\n"
    for attribute in _fields(node):
        yield f"- {attribute}"
    yield ""
    for method in _public(node.body):
        if ast.get_docstring(method) and isinstance(method, ast.FunctionDef):
            yield from _member(method, fence[1:])
    yield f"{fence}\n"


def signature(node: ast.FunctionDef) -> str:
    """Name, arguments and result in one line."""
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{node.name}({ast.unparse(node.args)}){result}"


def _fields(node: ast.ClassDef) -> Iterator[str]:
    """Annotated fields of a class."""
    for entry in node.body:
        if isinstance(entry, ast.AnnAssign) and isinstance(entry.target, ast.Name):
            yield f"`{entry.target.id}: {ast.unparse(entry.annotation)}`"
