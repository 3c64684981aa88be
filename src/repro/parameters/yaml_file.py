"""YAML files of plain values: every key is a string and appears once, numbers are finite."""

from pathlib import Path

import yaml

from repro.parameters.values import ParameterError

Loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)  # the same language, ten times faster
LARGEST = 1e18  # of a number; larger integers do not fit into NumPy's


def read_yaml(path: str | Path) -> dict:
    """Content of a YAML file that is a mapping. Raises ParameterError, in one line."""
    try:
        loader = Loader(Path(path).read_text())
        node = loader.get_single_node()
        repeated = _repeated_key(node, set())
        content = None if node is None or repeated else loader.construct_document(node)
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except (yaml.YAMLError, ValueError, RecursionError) as error:  # 2012-13-40 is no date
        raise ParameterError(f"{path}: not YAML: {' '.join(str(error).split())}") from None
    if repeated:
        raise ParameterError(f"{path}: {repeated}")
    if not isinstance(content, dict):
        raise ParameterError(f"{path}: not a mapping of keys to values")
    check_plain(content, str(path))
    return content


def _repeated_key(node: yaml.Node | None, seen: set[int]) -> str | None:
    """What to do about a key that a mapping has twice: YAML alone would use the last."""
    if id(node) in seen or not isinstance(node, yaml.CollectionNode):
        return None
    seen.add(id(node))
    inner = node.value
    if isinstance(node, yaml.MappingNode):
        keys = [key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
        for i, key in enumerate(keys):
            if key in keys[:i]:
                line = node.value[i][0].start_mark.line + 1
                return f"line {line}: the key '{key}' appears a second time; remove one"
        inner = [value for _, value in node.value]
    return next(filter(None, (_repeated_key(value, seen) for value in inner)), None)


def check_plain(content: object, where: str, inside: tuple[int, ...] = ()) -> None:
    """Raise ParameterError for what YAML has and JSON has not: here it is a typing error."""
    if id(content) in inside:
        raise ParameterError(f"{where}: contains itself; remove the alias")
    match content:
        case dict():
            for key, value in content.items():
                if not isinstance(key, str):
                    raise ParameterError(
                        f"{where}: the key {key!r} is not a string; put it in quotes"
                    )
                check_plain(value, f"{where}: {key}", (*inside, id(content)))
        case list():
            for value in content:
                check_plain(value, where, (*inside, id(content)))
        case None | str() | bool():
            pass
        case int() | float() if abs(content) <= LARGEST:  # not so for nan
            pass
        case int() | float():
            raise ParameterError(f"{where}: is not a finite number of at most {LARGEST:g}")
        case _:
            raise ParameterError(f"{where}: is a {type(content).__name__}; put it in quotes")
