"""Battery, harvest and saturation by hand."""

import numpy as np
import pytest

from repro import plugins
from repro.network import energy_harvesting, saturation
from repro.network.energy_harvesting import EnergyQueue
from repro.papers.energy_harvesting.claims import CLAIMS
from repro.parameters.load import ParameterError, load_paper
from repro.verdicts.published import read_published
from tests.conftest import ROOT, points

PI_1 = np.array(
    [[0.5, 0.2, 0.2, 0.1], [0.4, 0.4, 0.1, 0.1], [0.3, 0.3, 0.2, 0.2], [0.3, 0.1, 0.2, 0.4]]
)
PI_2 = np.array(
    [[0.8, 0.1, 0.05, 0.05], [0.7, 0.1, 0.1, 0.1], [0.6, 0.2, 0.1, 0.1], [0.5, 0.2, 0.2, 0.1]]
)
UNIFORM = np.full(4, 0.25)
STUDIES = ("ungm", "rss_2d", "rss_3d")


def queue(transition, initial=UNIFORM, energy=1, capacity=3):
    return EnergyQueue(np.asarray(transition), initial, energy, capacity)


def test_saturation_acts_on_both_sides_and_keeps_the_sign():
    values = np.array([-50.0, -30.0, -1.0, 0.0, 12.0, 31.0])
    np.testing.assert_array_equal(
        saturation.saturated(values, 30.0), [-30.0, -30.0, -1.0, 0.0, 12.0, 30.0]
    )


def test_energy_by_hand():
    # E(0) = 1; a unit is spent first, then H(k) is stored up to the capacity (6)
    harvested = np.array([3, 0, 0, 2, 3, 0])  # H(0) is never stored
    np.testing.assert_array_equal(
        energy_harvesting.energy(harvested, queue(PI_1)), [1, 0, 0, 2, 3, 2]
    )


def test_harvest_is_the_chain_of_its_matrix():
    uniforms = np.random.default_rng(1).random((4000, 60))
    units = energy_harvesting.harvest(uniforms, queue(PI_1))
    before, after = units[:, :-1].ravel(), units[:, 1:].ravel()
    for u in range(4):
        share = np.bincount(after[before == u], minlength=4) / (before == u).sum()
        error = np.sqrt(PI_1[u] * (1 - PI_1[u]) / (before == u).sum())
        assert np.all(np.abs(share - PI_1[u]) < 4 * error)


@pytest.mark.parametrize(("transition", "first"), [(PI_1, 0.625), (PI_2, 0.35)])
def test_first_transmission_probability_by_hand(transition, first):
    # E(0) = 1 is spent, so that the sensor transmits at k = 1 exactly if H(1) > 0
    for rule in ("lemma1", "exact"):
        probability = energy_harvesting.transmission_probability(queue(transition), 1, rule)
        assert probability == pytest.approx([1.0, first])


def test_stationary_law_stays():
    law = energy_harvesting.initial_harvest("stationary", PI_1)
    np.testing.assert_allclose(law @ PI_1, law, atol=1e-14)
    assert law.sum() == pytest.approx(1.0)


def test_never_empty_is_certain():
    always = np.tile([0.0, 0.5, 0.3, 0.2], (4, 1))
    for rule in ("lemma1", "exact"):
        probability = energy_harvesting.transmission_probability(queue(always), 30, rule)
        assert np.all(probability == 1.0)  # exactly: log(1 - lambda) is then -inf


def test_rows_of_the_harvest_must_sum_to_one(tmp_path):
    text = (ROOT / "params" / "energy_harvesting.yaml").read_text()
    file = tmp_path / "energy_harvesting.yaml"
    file.write_text(text.replace("[0.3, 0.1, 0.2, 0.4]", "[0.3, 0.1, 0.2, 0.5]", 1))
    with pytest.raises(ParameterError, match=r"harvest_transition: .*row 3 sums to 1\.1"):
        load_paper(file)


@pytest.mark.parametrize("study", STUDIES)
def test_every_value_is_described(study):
    scenario = plugins.study(study)
    for model in (scenario.Parameters, scenario.Analysis):
        assert not [name for name, field in model.model_fields.items() if not field.description]


@pytest.mark.parametrize(
    ("study", "changes", "message"),
    [
        ("ungm", {"initial_energy": 4}, "initial_energy is 4; energy_capacity allows at most 3"),
        ("rss_2d", {"sensors": 7}, "sensors is 7; sensor_positions allows at most 6"),
        ("rss_3d", {"measurement_variances": [0.1]}, "measurement_variances allows at most 1"),
        ("rss_2d", {"sensor_positions": [[0.0, 0.0, 0.0]]}, r"sensor_positions\.0: has 3 entries"),
        ("rss_3d", {"true_initial_state": [0.0] * 4}, "true_initial_state: has 4 entries"),
        ("rss_2d", {"saturation_level": 0.0}, "saturation_level: 0.0 is too small"),
        ("ungm", {"initial_harvest": "none"}, "initial_harvest: 'none' is not 'uniform', 'zero'"),
    ],
)
def test_parameters_that_do_not_fit_are_refused(study, changes, message):
    parameters = points()[study]["base"].parameters
    with pytest.raises(ParameterError, match=message):
        type(parameters).checked({**parameters.plain(), **changes}, "test")


def test_claims_have_the_names_of_the_published_file():
    published = read_published(ROOT / "params" / "published" / "energy_harvesting.csv")
    assert [claim.item for claim in CLAIMS] == list(published["item"])
