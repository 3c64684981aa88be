"""Studies and filters are found by the names of their modules: one file each, no list to add to."""

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

from repro.errors import ReproError

if TYPE_CHECKING:  # the studies import this module
    from repro.studies import Study


def study(name: str) -> "Study":
    """The STUDY of repro.studies.<name>. Raises ReproError if there is none."""
    return _member("study", f"repro.studies.{name}", ("STUDY",)).STUDY


def filter_module(name: str) -> ModuleType:
    """The module of a filter, checked for what the runner needs of it. Raises ReproError."""
    return _member("filter", f"repro.filters.{name}", ("LABEL", "SEES", "build"))


def _member(kind: str, dotted: str, needed: tuple[str, ...]) -> ModuleType:
    name, file = dotted.rsplit(".", 1)[1], f"src/{dotted.replace('.', '/')}.py"
    try:
        module = import_module(dotted)
    except ModuleNotFoundError as error:
        if error.name != dotted:
            raise
        raise ReproError(f"{kind} {name}: there is no {file}") from None
    for attribute in needed:
        if not hasattr(module, attribute):
            raise ReproError(f"{kind} {name}: {file} defines no {attribute}")
    return module
