"""The results as an RO-Crate: tables, verdicts, pages and figures with their parameters."""

import json
from pathlib import Path

from rocrate.rocrate import ROCrate  # pyright: ignore[reportMissingImports] - extra "archive"

from repro.atomic import atomic_write
from repro.errors import ReproError
from repro.provenance.manifest import check_manifest

KINDS = {".csv": "text/csv", ".md": "text/markdown", ".txt": "text/plain", ".png": "image/png"}


def write_archive(manifest: str | Path, licence: str, path: str | Path) -> None:
    """Zip everything of the manifest but the logs, with metadata. Raises ReproError if it is stale.

    The logs are left out for their size: the commit and seed in the manifest reproduce them.
    """
    check_manifest(manifest)
    content = json.loads(Path(manifest).read_text(encoding="utf-8"))
    crate = ROCrate()
    crate.name = "Filtering over unreliable networks: four papers, reproduced"
    crate.description = f"Results of repro {content['repro']} at commit {content['commit']}"
    crate.license = licence
    files = [*content["parameters"], *content["results"], str(manifest)]
    for name in files:
        kind = KINDS.get(Path(name).suffix, "application/octet-stream")
        if not name.endswith(".mcap"):
            digest = content["results"].get(name) or content["parameters"].get(name, "")
            crate.add_file(name, name, properties={"encodingFormat": kind, "sha256": digest})
    if not any(name.endswith("diff.csv") for name in files):
        raise ReproError(f"{manifest}: does not list diff.csv: run snakemake again")
    with atomic_write(path) as part:
        crate.write_zip(part)
