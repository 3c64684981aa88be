"""Studies and filters are found by the names of their modules: one file each, no list to add to."""

import traceback
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

from repro.errors import ReproError

if TYPE_CHECKING:  # the studies import this module
    from repro.studies import Study


def study(name: str) -> "Study":
    """The STUDY of repro.studies.<name>. Raises ReproError if there is none."""
    return _member("study", f"repro.studies.{name}", ("STUDY",)).STUDY


def filter_module(name: str) -> ModuleType:
    """The module of a filter, checked for what the runner needs of it. Raises ReproError."""
    return _member("filter", f"repro.filters.{name}", ("LABEL", "SEES", "build"))


def named_filter(filter_: str | Any) -> tuple[str, Any]:
    """Name and module of a filter given by its name, as its module, or as any object like one."""
    if isinstance(filter_, str):
        return filter_, filter_module(filter_)
    name = getattr(filter_, "__name__", type(filter_).__name__).rsplit(".", 1)[-1]
    _check(f"filter {name}", filter_, ("LABEL", "SEES", "build"))
    return name, filter_


def stream_of(name: str, module: Any) -> str:
    """Name of a filter's random streams: its own, or that of the filters it is paired with."""
    return f"filter:{getattr(module, 'STREAM', name)}"


def _member(kind: str, dotted: str, needed: tuple[str, ...]) -> ModuleType:
    name, file = dotted.rsplit(".", 1)[1], f"src/{dotted.replace('.', '/')}.py"
    try:
        module = import_module(dotted)
    except ReproError:
        raise
    except Exception as error:
        if isinstance(error, ModuleNotFoundError) and error.name == dotted:
            raise ReproError(f"{kind} {name}: there is no {file}") from None
        raise _broken(f"{kind} {name}: {file}", error) from error
    _check(f"{kind} {name}: {file}", module, needed)
    return module


def _broken(where: str, error: Exception) -> ReproError:
    """The fault of a module that cannot be imported, with its own part of the traceback."""
    fault = ReproError(f"{where}: {type(error).__name__}: {error}")
    frames = traceback.extract_tb(error.__traceback__)
    own = [f for f in frames if f.filename != __file__ and "importlib" not in f.filename]
    fault.details = "".join(traceback.format_list(own))
    return fault


def _check(where: str, module: Any, needed: tuple[str, ...]) -> None:
    for attribute in needed:
        if not hasattr(module, attribute):
            raise ReproError(f"{where} defines no {attribute}")
    if isinstance(getattr(module, "SEES", ()), str):
        raise ReproError(f"{where}: SEES is a string; write a tuple: SEES = ('{module.SEES}',)")
