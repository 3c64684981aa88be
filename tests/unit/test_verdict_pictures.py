"""What the pictures of the verdicts draw: nothing that is not there, and all that is."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from repro.plot import style
from repro.plot.robustness import OTHER, REVERSED, SAME, robustness
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
    diff = pd.concat(tables).reindex(columns=[*VALUES.columns]).assign(paper="p")
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


def test_marks_far_away_are_arrows_and_numbers_without_an_error_are_not_drawn():
    drawn = verdicts(results(VALUES, CLAIMS), "p")
    of_values, of_claims = drawn.axes
    assert marks(of_values) == [(0.0, "o"), (LARGEST, ">")]
    assert marks(of_claims) == [(4.0, "|"), (LARGEST, ">")]
    texts = [text.get_text() for text in of_claims.texts]
    assert "no error: 1 holds" in texts and "no error: 1 undecided" in texts
    assert drawn.get_suptitle().splitlines() == [
        "Exact values: 1 differs",
        "Table 1: c: printed 7, ours 8",
    ]
    names = [label.get_text() for label in of_values.get_yticklabels()]
    assert names == ["fitted", "Table 1: a: match", "Table 1: b: differs"]


def test_nothing_is_drawn_for_a_panel_without_rows():
    assert len(verdicts(results(CLAIMS), "p").axes) == 1
    assert len(verdicts(results(VALUES[2:], CLAIMS), "p").axes) == 1


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
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert names == ["Author, Other (2001)", "values: none printed", "claims, predicted"]
    assert [text.get_text() for text in axes.texts] == ["1", "1"]
