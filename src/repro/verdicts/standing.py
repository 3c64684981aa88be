"""What a verdict rests on: whether it is the same under every reading of its paper."""

import pandas as pd

OPPOSITE = {"match": "differs", "differs": "match", "holds": "fails", "fails": "holds"}
STANDINGS = ("robust", "conditional", "reversed")  # how `standing` begins
NOT_RUN = "not run"  # the reading has no point that the claim needs


def standing(verdict: str, readings: pd.DataFrame) -> str:
    """What a verdict rests on, from its rows of the readings: see `robustness.COLUMNS`."""
    judged = readings.loc[readings["verdict"] != NOT_RUN]
    if judged.empty:
        return ""
    reversed_ = judged.loc[judged["verdict"] == OPPOSITE.get(verdict, "")]
    other = judged.loc[judged["verdict"] != verdict]
    if not reversed_.empty:
        return f"reversed under {_named(reversed_)}"
    if not other.empty:
        return f"conditional on {_named(other)}"
    return f"robust ({len(judged)} {'reading' if len(judged) == 1 else 'readings'})"


def _named(readings: pd.DataFrame) -> str:
    return ", ".join(dict.fromkeys(name.removeprefix("reading-") for name in readings["reading"]))
