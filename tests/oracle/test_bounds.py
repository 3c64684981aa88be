"""The lower bounds against cases with a closed form, and against the filters that they bound."""

import numpy as np

from repro import plugins
from repro.runner import run
from repro.statistics.consistency import claimed
from repro.studies.families import signal_strength
from repro.studies.families.information import Information
from repro.tables.bounds import cramer_rao
from tests.conftest import settings, small_log


def riccati(information: Information, arrived: np.ndarray) -> np.ndarray:
    """Covariances (steps, n, n) by the Riccati equation in its information form."""
    found, p = [], information.start
    for k, arrives in enumerate(arrived):
        if k > 0:
            p = information.transition @ p @ information.transition.T + information.noise
        if k >= information.first:
            total = (arrives[:, None, None] * information.informations[k]).sum(axis=0)
            p = np.linalg.inv(np.linalg.inv(p) + total)
        found.append(p)
    return np.array(found)


def test_of_a_linear_system_it_is_the_riccati_equation():
    """With known losses, of each arrival sequence; the Kalman filter that knows them attains it."""
    log, study = small_log("linear_losses", "loss=0.5", 6, 20), plugins.study("linear_losses")
    information = study.information(log)
    bound = cramer_rao(study, information)["state"]
    for trial, arrived in enumerate(information.arrived):
        expected = np.trace(riccati(information, arrived), axis1=1, axis2=2)
        np.testing.assert_allclose(bound[trial], expected, rtol=1e-10)
    _, runs = run(log, "iekf", settings("linear_losses", "loss=0.5", "iekf"), consistency=True)
    np.testing.assert_allclose(bound, runs.recorded[claimed("state")], rtol=1e-9)


def test_the_radar_bound_is_below_the_filter_that_knows_the_losses():
    log, study = small_log("radar", "loss=0.1", 200, 30), plugins.study("radar")
    bound = cramer_rao(study, study.information(log))["position"][:, 1:]
    _, runs = run(log, "iekf", settings("radar", "loss=0.1", "iekf"))
    assert (
        bound.mean(axis=0) < 1.02 * (runs.error[..., [0, 3]] ** 2).sum(-1).mean(axis=0)[1:]
    ).all()


def test_gradient_of_the_signal_strength_is_its_difference_quotient():
    log = small_log("rss_3d", "base", 2, 4)
    truth, step = log.values["/truth"], 1e-5
    gradient = signal_strength.gradient(log.parameters, truth, 1)
    for j in range(truth.shape[-1]):
        moved = [truth + sign * step * np.eye(truth.shape[-1])[j] for sign in (1, -1)]
        up, down = (signal_strength.level(log.parameters, np.moveaxis(of, 2, 1), 1) for of in moved)
        np.testing.assert_allclose(gradient[..., j], (up - down) / (2 * step), atol=1e-6)
