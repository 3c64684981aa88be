"""Reference of all parameters, from the types that check them: docs/parameters.md.

python -m repro.pages.parameter_reference > docs/parameters.md
"""

import pkgutil
from collections.abc import Iterator
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import AfterValidator
from pydantic.fields import FieldInfo

from repro import plugins, studies
from repro.parameters.load import Run
from repro.parameters.settings import SETTINGS
from repro.parameters.values import Values

TITLE = """\
# Parameters, by study and filter

Generated from the types by `python -m repro.pages.parameter_reference > docs/parameters.md`;
a test fails if the two differ. The values and their sources are in `params/`, whose files
[params/README.md](../params/README.md) describes.
"""
BOUNDS = {"ge": "≥", "gt": ">", "le": "≤", "lt": "<"}
BOUNDS |= {"min_length": "at least", "max_length": "at most"}
SCALARS = {int: "integer", float: "number", str: "string", bool: "true or false"}


def reference() -> str:
    """The page, in Markdown."""
    sections = [TITLE, *_section("params/run.yaml and --config", Run)]
    for name in sorted(module.name for module in pkgutil.iter_modules(studies.__path__)):
        if name != "families":
            study = plugins.study(name)
            sections += _section(f"Study `{name}`", study.Parameters)
            sections += _section(f"Analysis of `{name}`", study.Analysis)
    for model in dict.fromkeys(SETTINGS.values()):
        filters = ", ".join(f"`{name}`" for name, settings in SETTINGS.items() if settings is model)
        sections += _section(f"Filters {filters}", model)
    return "\n".join(sections)


def meanings(model: type[Values]) -> dict[str, str]:
    """What each field of a model means, with its unit."""
    fields = model.model_fields.items()
    return {name: _description(field.annotation, field) or "" for name, field in fields}


def _section(title: str, model: type[Values]) -> Iterator[str]:
    """Heading and table of a model; nothing for a model without fields."""
    if model.model_fields:
        yield f"## {title}\n\n| name | type and bounds | meaning |\n|---|---|---|"
        meaning_of = meanings(model)
        for name, field in model.model_fields.items():
            kind = _kind(field.annotation, field.metadata) + _default(field)
            yield f"| `{name}` | {kind} | {meaning_of[name]} |"
        yield ""


def _default(field: FieldInfo) -> str:
    value = None if field.is_required() else field.get_default(call_default_factory=True)
    return "" if value is None else f"; default `{value}`"


def _description(annotation: Any, field: FieldInfo | None = None) -> str | None:
    """What a field, or the type that it has, says of its meaning and unit."""
    if field is not None and field.description:
        return field.description
    if get_origin(annotation) is Annotated:
        described = [m.description for m in get_args(annotation)[1:] if isinstance(m, FieldInfo)]
        return next(filter(None, described), None)
    inner = get_args(annotation) if get_origin(annotation) in (Union, UnionType) else ()
    return next(filter(None, map(_description, inner)), None)


def _kind(annotation: Any, metadata: list[Any]) -> str:
    """A type and its bounds in words."""
    arguments = get_args(annotation)
    match get_origin(annotation):
        case origin if origin is Annotated:
            return _kind(arguments[0], [*_flat(arguments[1:]), *metadata])
        case origin if origin is Literal:
            return " or ".join(f"`{value}`" for value in arguments)
        case origin if origin in (Union, UnionType):
            kinds = [_kind(argument, []) for argument in arguments if argument is not NoneType]
            optional = [", optional"] if NoneType in arguments else []
            return " or ".join(kinds) + "".join(optional)
        case origin if origin is dict:
            return _bounded(f"mapping to ({_kind(arguments[1], [])})", metadata)
        case origin if origin is list or arguments[-1:] == (Ellipsis,):
            return _bounded(f"list of ({_kind(arguments[0], [])})", metadata)
        case origin if origin is tuple:
            kinds = list(dict.fromkeys(_kind(argument, []) for argument in arguments))
            return _bounded(f"{len(arguments)} × ({', '.join(kinds)})", metadata)
    if isinstance(annotation, type) and issubclass(annotation, Values):
        fields = annotation.model_fields.items()
        kinds = (f"`{name}` ({_kind(f.annotation, f.metadata)})" for name, f in fields)
        return f"mapping of {', '.join(kinds)}"
    return _bounded(SCALARS.get(annotation, "any"), metadata)


def _flat(metadata: tuple[Any, ...]) -> list[Any]:
    """Constraints of an annotation; pydantic's Field holds several."""
    return [
        constraint
        for entry in metadata
        for constraint in (entry.metadata if isinstance(entry, FieldInfo) else [entry])
    ]


def _bounded(kind: str, metadata: list[Any]) -> str:
    bounds = [
        f"{words} {bound:g}"
        for entry in metadata
        for name, words in BOUNDS.items()
        if isinstance(bound := getattr(entry, name, None), int | float)
    ]
    bounds += [entry.func.__name__.strip("_") for entry in metadata if _is_check(entry)]
    return ", ".join([kind.replace(" × (number)", " numbers"), *bounds])


def _is_check(entry: Any) -> bool:
    """Whether a constraint is a function of this project, whose name says what it checks."""
    return isinstance(entry, AfterValidator) and hasattr(entry.func, "__name__")


if __name__ == "__main__":
    print(reference(), end="")
