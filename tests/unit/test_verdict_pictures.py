"""What the pictures of the verdicts draw: nothing that is not there, and all that is."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from repro.plot import style
from repro.plot.robustness import OTHER, REVERSED, SAME, robustness
from repro.plot.scoreboard import scoreboard
from repro.plot.tally import tally
from repro.plot.verdicts import LARGEST, verdicts

VALUES = pd.DataFrame(
    {
        "item": ["Table 1: a", "Table 1: b", "Table 1: c"],
        "kind": "value",
        "class": ["fitted", "fitted", "identity"],
        "published": [1.0, 1.0, 7.0],
        "ours": [1.0, 5.0, 8.0],
        "mcse": [0.1, 0.1, 0.0],
        "their_error": [0.1, 0.1, 0.0],
        "allowed": [0.45, 0.45, 0.0],
        "z": [0.0, 28.0, np.nan],
        "on_edge": False,
        "verdict": ["match", "differs", "differs"],
        "standing": ["reversed under x", np.nan, np.nan],
    }
)
CLAIMS = pd.DataFrame(
    {
        "item": ["a-below-b", "b-below-c"],
        "kind": "claim",
        "class": "predicted",
        "verdict": ["holds", "undecided"],
        "statement": ["Fig. 1: A is below B.", "Fig. 2: B is below C."],
        "standing": ["conditional on y", "robust (1 reading)"],
    }
)
PARTS = pd.DataFrame(
    {
        "item": ["a-below-b", "a-below-b", "a-below-b", "b-below-c"],
        "margin": [-4.0, -40.0, -np.inf, np.nan],
        "verdict": ["holds", "holds", "holds", "undecided"],
    }
)
UNDER = pd.DataFrame(
    [
        ("Table 1: a", "value", "reading-x", "differs", 9.0),
        ("a-below-b", "claim", "reading-x", "holds", -5.5),
        ("a-below-b", "claim", "reading-y", "undecided", 1.0),
        ("b-below-c", "claim", "reading-x", "undecided", np.nan),
        ("b-below-c", "claim", "reading-y", "not run", np.nan),
    ],
    columns=["item", "kind", "reading", "verdict", "margin"],
).assign(paper="p")


def results(*tables):
    diff = pd.concat(tables).reindex(columns=[*VALUES.columns, "statement"]).assign(paper="p")
    return SimpleNamespace(
        diff=lambda: diff,
        claims=lambda paper: PARTS,
        robustness=lambda: UNDER,
        authors=lambda: {"p": "A. B. Author, C.-D. Other (2001)"},
        tolerance=3.0,
    )


@pytest.fixture(autouse=True)
def closed():
    yield
    style.pyplot.close("all")


def marks(axes):
    """(x, marker) of each mark by row; the vertical line at zero is none."""
    drawn = [line for line in axes.lines if line.get_linestyle() == "None"]
    return [(float(np.ravel(d.get_xdata())[0]), d.get_marker()) for d in drawn]


def rows_of(axes):
    """The words at the left of a panel, and those beside or inside it."""
    left = [label.get_text() for label in axes.get_yticklabels()]
    return left, [text.get_text() for text in axes.texts]


def test_marks_far_away_are_arrows_and_exact_checks_have_panels_of_words():
    of_values, exact_values, of_claims, exact_claims = verdicts(results(VALUES, CLAIMS), "p").axes
    assert marks(of_values) == [(0.0, "o"), (LARGEST, ">")]
    assert rows_of(of_values) == (["fitted", "Table 1: a", "Table 1: b"], ["match", "differs"])
    assert rows_of(exact_values) == (
        ["identity", "Table 1: c"],
        ["differs: printed 7, ours 8"],
    )
    assert marks(of_claims) == [(4.0, "|"), (LARGEST, ">")]
    assert rows_of(of_claims) == (["predicted", "Fig. 1: A is below B."], ["holds; exact: 1 holds"])
    assert not exact_claims.lines
    assert rows_of(exact_claims) == (
        ["predicted", "Fig. 2: B is below C."],
        ["undecided (1 undecided)"],
    )


def test_nothing_is_drawn_for_a_panel_without_rows():
    assert len(verdicts(results(CLAIMS[:1]), "p").axes) == 1
    assert len(verdicts(results(VALUES[2:], CLAIMS[:1]), "p").axes) == 2


def test_the_most_fragile_verdict_is_first_and_what_is_not_run_is_blank():
    (axes,) = robustness(results(VALUES, CLAIMS), "p").axes
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert names == ["Table 1: a: match", "a below b: holds", "b below c: undecided"]
    assert [label.get_text() for label in axes.get_xticklabels()] == ["x", "y"]
    cells = {
        (round(p.get_y() + 0.44), round(p.get_x() + 0.46)): style.matplotlib.colors.to_hex(
            p.get_facecolor()
        )
        for p in axes.patches
    }
    expected = {(0, 0): REVERSED, (1, 0): SAME, (1, 1): OTHER, (2, 0): SAME}
    assert cells == {place: colour.lower() for place, colour in expected.items()}
    assert [text.get_text() for text in axes.texts] == ["9.0", "5.5", "-1.0", ""]


def test_the_tally_names_authors_and_says_that_no_value_is_printed():
    (axes,) = tally(results(CLAIMS)).axes
    names, numbers = rows_of(axes)
    assert names == [
        *("Author, Other (2001)", "values: none printed", "claims, predicted"),
        *("all papers", "values: 0", "claims: 2"),
    ]
    assert numbers == ["1", "1", "1", "1"]


def test_the_scoreboard_counts_verdicts_classes_and_standings():
    values, claims, classes, standings = scoreboard(results(VALUES, CLAIMS)).axes
    assert values.get_title() == "1 of 3 published values match"
    assert claims.get_title() == "1 of 2 claims hold"
    assert [text.get_text() for text in classes.texts] == ["1", "2", "2"]
    assert [text.get_text() for text in standings.texts] == ["1", "1", "1", "2"]
