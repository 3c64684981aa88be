"""What a verdict rests on: whether it is the same under every reading of its paper."""

import numpy as np
import pandas as pd

OPPOSITE = {"match": "differs", "differs": "match", "holds": "fails", "fails": "holds"}
STANDINGS = ("robust", "open", "conditional", "reversed")  # how `standing` begins
MOST = 4  # names of readings; results/robustness.csv has all
NOT_RUN = "not run"  # the reading has no point that the claim needs
NEEDS_NONE = "needs none"  # what no run and no reading concern: a count, a time measured elsewhere


def too_few_trials(verdict: str, under: str, margin: float) -> bool:
    """Whether a reading leaves a decided claim undecided, but on the same side of zero."""
    side = {"holds": -1.0, "fails": 1.0}.get(verdict, 0.0)
    return under == "undecided" and side * margin > 0


def standing(verdict: str, readings: pd.DataFrame) -> str:
    """What a verdict rests on, from its rows of the readings: see `robustness.COLUMNS`.

    A reading that has too few trials to decide changes nothing; of what no reading can concern the
    row `changes` says why.
    """
    none = readings.loc[readings["verdict"] == NEEDS_NONE]
    if not none.empty:
        return f"{NEEDS_NONE} ({none['changes'].iloc[0]})"
    judged = readings.loc[readings["verdict"] != NOT_RUN]
    if judged.empty:
        return ""
    cells = zip(judged["verdict"], judged["margin"], strict=True)
    few = np.array([too_few_trials(verdict, under, margin) for under, margin in cells])
    reversed_ = judged.loc[judged["verdict"] == OPPOSITE.get(verdict, "")]
    other = judged.loc[(judged["verdict"] != verdict) & ~few]
    if not reversed_.empty:
        return f"reversed under {_named(reversed_)}"
    if not other.empty:
        return f"conditional on {_named(other)}"
    decided = len(judged) - int(few.sum())
    if decided == 0:
        return f"open (too few trials in {_number(len(judged))})"
    too_few = f"; too few trials in {len(judged) - decided} more" * bool(few.any())
    return f"robust ({_number(decided)}{too_few})"


def _number(readings: int) -> str:
    return f"{readings} reading{'s' * (readings > 1)}"


def _named(readings: pd.DataFrame) -> str:
    names = list(dict.fromkeys(name.removeprefix("reading-") for name in readings["reading"]))
    more = f" and {len(names) - MOST} more" * (len(names) > MOST)
    return ", ".join(names[:MOST]) + more
