"""Probabilities that a fresh root seed gives another verdict, against simulated seeds."""

import numpy as np
import pytest

from repro.verdicts.claims import RISKS, Part, below, possible_overall, risk
from repro.verdicts.published import compare_value, value_risk

SEEDS = 4000
TOLERANCE = 3.0
NOISE = np.random.default_rng(1).normal(scale=np.sqrt(2), size=(2, SEEDS))  # ours and its own
EXACT = 4 * np.sqrt(0.25 / SEEDS)  # four standard errors of a share


def fresh(part: Part, noise: float) -> Part:
    """The part as another seed may give it."""
    error = part.mcse if part.seed_error is None else part.seed_error
    return part._replace(difference=part.difference + noise * error)


def share_not_possible(parts: list[Part], noise: np.ndarray, expect: str) -> float:
    """Share of the simulated seeds, (parts, seeds), that cannot give the expected verdict."""
    of_seeds = (
        possible_overall(
            [fresh(p, n).possible(TOLERANCE) for p, n in zip(parts, of_one, strict=True)]
        )
        for of_one in noise.T
    )
    return float(np.mean([expect not in possible for possible in of_seeds]))


def risk_of(parts: list[Part], expect: str) -> float:
    risks = [part.risks(TOLERANCE) for part in parts]
    return risk(expect, {name: np.array([r[name] for r in risks]) for name in RISKS})


@pytest.mark.parametrize("expect", ["holds", "undecided", "fails"])
@pytest.mark.parametrize("difference", [-0.55, -0.02, 0.1, 0.65])
def test_the_risk_of_one_comparison(difference, expect):
    part = Part("", difference, 0.1)
    assert risk_of([part], expect) == pytest.approx(
        share_not_possible([part], NOISE[:1], expect), abs=EXACT
    )


@pytest.mark.parametrize("expect", ["holds", "fails"])
def test_the_risk_of_a_bound_that_allows_for_the_error_already(expect):
    part = below("", 2.2, 2.0, seed_error=0.1)
    simulated = share_not_possible([part], NOISE[:1], expect)
    assert 0.01 < simulated < 0.99 or expect == "fails"
    assert risk_of([part], expect) == pytest.approx(simulated, abs=EXACT)
    assert risk_of([below("", 1.0, 2.0)], expect) == (expect == "fails")


@pytest.mark.parametrize("expect", ["holds", "undecided", "fails"])
@pytest.mark.parametrize("differences", [(-0.1, 0.1), (-0.5, -0.6), (0.5, -0.8)])
def test_the_risk_of_a_claim_is_an_upper_bound_however_its_parts_go_together(differences, expect):
    parts = [Part("", difference, 0.1) for difference in differences]
    for noise in (NOISE, NOISE[[0, 0]], np.stack([NOISE[0], -NOISE[0]])):
        assert share_not_possible(parts, noise, expect) <= risk_of(parts, expect) + EXACT


@pytest.mark.parametrize("expect", ["match", "differs"])
@pytest.mark.parametrize("value", [5.3, 5.55, 6.0])
def test_the_risk_of_a_value(value, expect):
    def compared(value):
        ours = {"value": value, "mcse": 0.1, "trials": 400}
        return compare_value(5.0, 2, 100, ours, TOLERANCE)

    seeds = [compared(value + 0.1 * noise) for noise in NOISE[0]]
    not_possible = [not (row["on_edge"] or row["verdict"] == expect) for row in seeds]
    risk_ = value_risk(expect, compared(value), TOLERANCE)
    assert risk_ == pytest.approx(np.mean(not_possible), abs=EXACT)


def test_an_exact_value_has_no_risk_or_is_sure_to_fail():
    ours = {"value": 5.0, "mcse": 0.0, "trials": 1}
    compared = compare_value(5.0, 2, 1, ours, TOLERANCE)
    assert [value_risk(e, compared, TOLERANCE) for e in ("match", "differs")] == [0.0, 1.0]
