"""Text files are UTF-8 whatever the locale: every reader and writer says so."""

import ast

from tests.conftest import ROOT


def opens_text(call):
    """Whether a call opens a file as text."""
    name = getattr(call.func, "attr", getattr(call.func, "id", ""))
    modes = [a.value for a in call.args if isinstance(a, ast.Constant) and isinstance(a.value, str)]
    binary = any("b" in mode for mode in modes) or "force_zip64" in {k.arg for k in call.keywords}
    module = getattr(getattr(call.func, "value", None), "id", "")
    return name in ("read_text", "write_text") or (
        name == "open" and not binary and module not in ("os", "Image")  # no files of text
    )


def test_every_text_file_is_opened_as_utf8():
    found = [
        f"{file.relative_to(ROOT)}:{node.lineno}"
        for folder in ("src", "workflow", "figures")
        for file in (ROOT / folder).rglob("*.py")
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and opens_text(node)
        if "encoding" not in {keyword.arg for keyword in node.keywords}
    ]
    assert found == []
