"""How numbers are written to CSV files."""

from pathlib import Path

import pandas as pd

from repro.atomic import atomic_write


def write_csv(rows: list[dict] | pd.DataFrame, path: str | Path) -> None:
    """One way of writing numbers, so that equal results are equal bytes."""
    frame = pd.DataFrame(rows)
    # pandas would ask of each number whether it is one, and take three times as long.
    texts = {name: _texts(frame[name].tolist()) for name in frame.select_dtypes("float")}
    with atomic_write(path) as part:
        frame.assign(**texts).to_csv(part, index=False, lineterminator="\n")


def _texts(numbers: list[float]) -> list[str]:
    """Nine digits; nothing of a NaN."""
    return ["" if number != number else f"{number:.9g}" for number in numbers]
