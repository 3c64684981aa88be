"""The contract of every registered filter; the filters are found through the registry."""

import numpy as np
import pytest

from repro import plugins
from repro.network.channels import ALWAYS_SEEN
from repro.runner import run
from tests.conftest import registered, settings, small_log

FILTERS = [pytest.param(*entry, id=f"{entry[0]}-{entry[1]}") for entry in registered()]
CHANGED_AFTER = 6


def estimate(log, name, point):
    return run(log, name, settings(log.study, point, name))[0]


@pytest.mark.parametrize(("name", "study", "point"), FILTERS)
def test_estimates_are_finite_and_of_the_states_shape(name, study, point):
    log = small_log(study, point)
    found = estimate(log, name, point)
    states = len(plugins.study(study).model(log.parameters).initial_mean)
    truth = log.values.get("/truth", np.empty((5, log.steps, states)))  # a closed loop has none yet
    assert found.shape == truth.shape
    assert np.isfinite(found).all()


@pytest.mark.parametrize(("name", "study", "point"), FILTERS)
def test_same_seed_same_result_and_batches_do_not_matter(name, study, point):
    together = estimate(small_log(study, point), name, point)
    alone = [estimate(small_log(study, point, 1, first=i), name, point) for i in range(5)]
    np.testing.assert_array_equal(together, np.concatenate(alone))


@pytest.mark.parametrize(("name", "study", "point"), FILTERS)
def test_the_future_is_not_seen(name, study, point):
    log = small_log(study, point)
    values = {topic: array.copy() for topic, array in log.values.items()}
    for topic in values.keys() & {"/sensor", "/received"}:
        later = values[topic][:, CHANGED_AFTER + 1 :]
        values[topic][:, CHANGED_AFTER + 1 :] = later[:, ::-1]
    before, after = (estimate(entry, name, point) for entry in (log, log._replace(values=values)))
    np.testing.assert_array_equal(before[:, : CHANGED_AFTER + 1], after[:, : CHANGED_AFTER + 1])


@pytest.mark.parametrize(("name", "study", "point"), FILTERS)
def test_the_truth_is_not_seen(name, study, point):
    log = small_log(study, point)
    if "/truth" not in log.values:
        pytest.skip("a closed loop decides its own truth: tests/oracle checks what it shows")
    hidden = log.values | {"/truth": np.full_like(log.values["/truth"], np.nan)}
    np.testing.assert_array_equal(
        estimate(log, name, point), estimate(log._replace(values=hidden), name, point)
    )


@pytest.mark.parametrize(("name", "study", "point"), FILTERS)
def test_undeclared_channels_are_not_seen(name, study, point, monkeypatch):
    log, scenario = small_log(study, point), plugins.study(study)
    before = estimate(log, name, point)
    declared = {*plugins.filter_module(name).SEES, *ALWAYS_SEEN}
    channels = scenario.channels

    def scrambled(*arguments):
        loop = channels(*arguments)
        offers = loop.at

        def at(k, predicted):
            return {
                channel: value if channel in declared else np.full(np.shape(value), np.nan)
                for channel, value in offers(k, predicted).items()
            }

        loop.at = at
        return loop

    monkeypatch.setattr(scenario, "channels", scrambled)
    np.testing.assert_array_equal(before, estimate(log, name, point))
