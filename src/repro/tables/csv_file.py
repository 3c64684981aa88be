"""How numbers are written to CSV files."""

from pathlib import Path

import pandas as pd

from repro.atomic import atomic_write


def write_csv(rows: list[dict] | pd.DataFrame, path: str | Path) -> None:
    """One way of writing numbers, so that equal results are equal bytes."""
    with atomic_write(path) as part:
        pd.DataFrame(rows).to_csv(part, index=False, float_format="%.9g", lineterminator="\n")
