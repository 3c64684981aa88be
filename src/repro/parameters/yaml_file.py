"""YAML files of plain values: every key is a string and appears once, numbers are finite."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import yaml

from repro.parameters.values import ParameterError

Loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)  # the same language, ten times faster
LARGEST = 1e18  # of a number; larger integers do not fit into NumPy's
MOST = 100_000  # values of a file, each alias replaced by what it stands for
DEEPEST = 50  # lists and mappings inside each other


def read_yaml(path: str | Path) -> dict:
    """Content of a YAML file that is a mapping. Raises ParameterError, in one line."""
    try:
        content = parsed(Path(path).read_text(encoding="utf-8"), str(path))
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except (yaml.YAMLError, ValueError) as error:  # 2012-13-40 is no date
        raise ParameterError(f"{path}: not YAML: {' '.join(str(error).split())}") from None
    if not isinstance(content, dict):
        raise ParameterError(f"{path}: not a mapping of keys to values")
    check_plain(content, str(path))
    return content


def parsed(text: str, where: str) -> Any:
    """What a YAML text holds.

    Raises YAMLError or ValueError for a text that is not YAML, and ParameterError for a repeated
    key and for a text that would take long, or all memory, as aliases of aliases do.
    """
    depth = 0
    for event in yaml.parse(text, Loader):  # without recursion, unlike the loader
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        _check_depth(depth, where)
    loader = Loader(text)
    node = loader.get_single_node()
    if node is None:
        return None
    _check_size(node, _inside_node, where)
    repeated = _repeated_key(node, set())
    if repeated:
        raise ParameterError(f"{where}: {repeated}")
    return loader.construct_document(node)


def check_plain(content: object, where: str) -> None:
    """Raise ParameterError for what YAML has and JSON has not: here it is a typing error."""
    _check_size(content, _inside_value, where)
    _check_values(content, where)


def _check_values(content: object, where: str) -> None:
    match content:
        case dict():
            for key, value in content.items():
                if not isinstance(key, str):
                    raise ParameterError(
                        f"{where}: the key {key!r} is not a string; put it in quotes"
                    )
                _check_values(value, f"{where}: {key}")
        case list():
            for value in content:
                _check_values(value, where)
        case None | str() | bool():
            pass
        case int() | float() if abs(content) <= LARGEST:  # not so for nan
            pass
        case int() | float():
            raise ParameterError(f"{where}: is not a finite number of at most {LARGEST:g}")
        case _:
            raise ParameterError(f"{where}: is a {type(content).__name__}; put it in quotes")


def _check_depth(depth: int, where: str) -> None:
    if depth > DEEPEST:
        raise ParameterError(f"{where}: more than {DEEPEST} lists or mappings inside each other")


def _check_size(content: Any, inside: Callable[[Any], Iterable[Any]], where: str) -> None:
    """Raise ParameterError for too many values, whatever aliases stand for counted each time."""
    sizes: dict[int, int | None] = {}  # None: not counted to its end

    def size(value: Any, depth: int) -> int:
        _check_depth(depth, where)
        number = id(value)
        if number not in sizes:
            sizes[number] = None
            sizes[number] = 1 + sum(size(member, depth + 1) for member in inside(value))
        known = sizes[number]
        if known is None:
            raise ParameterError(f"{where}: contains itself; remove the alias")
        if known > MOST:
            raise ParameterError(
                f"{where}: more than {MOST} values, with each alias replaced by what it stands "
                "for; write fewer"
            )
        return known

    size(content, 0)


def _inside_node(node: yaml.Node) -> Iterable[yaml.Node]:
    if isinstance(node, yaml.MappingNode):
        return (one for pair in node.value for one in pair)
    return node.value if isinstance(node, yaml.SequenceNode) else ()


def _inside_value(value: object) -> Iterable[object]:
    if isinstance(value, dict):
        return value.values()
    return value if isinstance(value, list) else ()


def _repeated_key(node: yaml.Node, seen: set[int]) -> str | None:
    """What to do about a key that a mapping has twice: YAML alone would use the last."""
    if id(node) in seen or not isinstance(node, yaml.CollectionNode):
        return None
    seen.add(id(node))
    inner = node.value
    if isinstance(node, yaml.MappingNode):
        keys = [key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
        known: set[str] = set()
        for i, key in enumerate(keys):
            if key in known:
                line = node.value[i][0].start_mark.line + 1
                return f"line {line}: the key '{key}' appears a second time; remove one"
            known.add(key)
        inner = [value for _, value in node.value]
    return next(filter(None, (_repeated_key(value, seen) for value in inner)), None)
