"""Docstrings, which are written as Markdown, on a page."""

import inspect
import re

TAG = re.compile(r"<(?=[A-Za-z/!?])")
MEANT = re.compile(r"([*_$\[\]])")
CODE = re.compile(r"(`[^`]*`)")


def as_markdown(text: str) -> str:
    """A docstring with nothing but its `code` and its paragraphs meaning anything."""
    lines = inspect.cleandoc(text).splitlines()
    return "\n".join("".join(map(_shown, CODE.split(line.strip()))) for line in lines)


def _shown(part: str) -> str:
    return part if part.startswith("`") else MEANT.sub(r"\\\1", TAG.sub("&lt;", part))
