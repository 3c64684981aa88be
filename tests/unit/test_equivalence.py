import pytest

from repro.verdicts.claims import overall
from repro.verdicts.equivalence import equivalent


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    ("difference", "mcse", "verdict"),
    [
        (0.0, 0.1, "holds"),
        (0.69, 0.1, "holds"),  # three errors inside the margin of 1
        (0.71, 0.1, "undecided"),
        (1.29, 0.1, "undecided"),
        (1.31, 0.1, "fails"),
        (0.0, 0.4, "undecided"),  # no difference is found, and none of the size of 1 excluded
        (float("nan"), 0.1, "undecided"),
    ],
)
def test_equality_needs_both_sides_inside_the_margin(difference, mcse, verdict, sign):
    parts = equivalent("a - b", sign * difference, mcse, margin=1.0)
    assert overall(part.verdict(3) for part in parts) == verdict


def test_the_name_states_the_smallest_margin_that_would_hold():
    parts = equivalent("a - b", -0.3, 0.1, margin=0.5)
    assert {part.name.partition("(")[2] for part in parts} == {"0.3 + 0.1 t would hold)"}
    assert overall(part.verdict(3) for part in parts) == "undecided"
    parts = equivalent("a - b", -0.3, 0.1, margin=0.3 + 3 * 0.1 + 1e-9)
    assert overall(part.verdict(3) for part in parts) == "holds"
