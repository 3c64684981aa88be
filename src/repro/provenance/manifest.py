"""Provenance of the results: versions, commit, seed, and a hash of each file."""

import hashlib
import json
import platform
from importlib.metadata import version
from pathlib import Path

from repro import __version__
from repro.atomic import atomic_write
from repro.errors import ReproError

PACKAGES = ("snakemake", "numpy", "scipy", "pandas", "matplotlib", "mcap")


def sha256(path: str | Path) -> str:
    """Hash of a file's bytes."""
    with Path(path).open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def write_manifest(
    path: str | Path,
    commit: str,
    code: str,
    root_seed: int,
    parameters: list[str],
    results: list[str],
) -> None:
    """Write the manifest of the given parameter and result files; `code` is a digest of it."""
    content = {
        "repro": __version__,
        "commit": commit,
        "code": code,
        "root_seed": root_seed,
        "python": platform.python_version(),
        "platform": platform.platform(),
        "packages": {name: version(name) for name in PACKAGES},
        "parameters": {name: sha256(name) for name in sorted(parameters)},
        "results": {name: sha256(name) for name in sorted(results)},
    }
    with atomic_write(path) as part:
        part.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def check_manifest(path: str | Path) -> None:
    """Raise ReproError, which names the files, if some differ from the manifest."""
    content = json.loads(Path(path).read_text(encoding="utf-8"))
    changed = [
        f"{name} ({'changed' if Path(name).exists() else 'missing'})"
        for name, recorded in (content["parameters"] | content["results"]).items()
        if not Path(name).exists() or sha256(name) != recorded
    ]
    if changed:
        named = ", ".join(changed[:5]) + (f" and {len(changed) - 5} more" if changed[5:] else "")
        raise ReproError(f"{path}: files differ from the manifest: {named}: run snakemake again")
