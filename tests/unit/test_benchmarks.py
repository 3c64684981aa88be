"""The peers of the benchmarks solve the problem of the filter that they are timed beside."""

import importlib
from pathlib import Path

import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def side_by_side(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    return importlib.import_module("side_by_side")


@pytest.mark.parametrize("study", ["linear_losses", "radar"])
@pytest.mark.parametrize("peer", ["numpy_kalman", "filterpy_filters"])
def test_kalman_filters_agree(side_by_side, peer, study):
    given = side_by_side.problem("unknown_losses", study, "loss=0.5", 3)
    ours = side_by_side.of_project(given, "ekf")().estimate
    theirs = importlib.import_module(f"peers.{peer}").filtered(given.log, 3)()
    # A filter that takes lost packets for measurements loses its target, and digits with it.
    assert np.allclose(theirs[:, :30], ours[:, :30], rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("study", ["ungm", "rss_2d"])
@pytest.mark.parametrize(
    ("library", "peer"), [("particles", "particles_library"), ("jax", "jax_bootstrap")]
)
def test_particle_filters_estimate_the_same(side_by_side, library, peer, study):
    pytest.importorskip(library)
    trials, count = 4, 5000  # so many that all come near the exact posterior mean
    given = side_by_side.problem("energy_harvesting", study, "base", trials)
    settings = given.settings["pf_ross_eh"] | {"particles": count}
    given = given._replace(settings={"pf_ross_eh": settings})
    ours = side_by_side.of_project(given, "pf_ross_eh")().estimate
    theirs = importlib.import_module(f"peers.{peer}").bootstrap(given.log, count, trials)()
    error = ours - given.log.values["/truth"][:, 1:]
    apart = np.sqrt(((theirs - ours) ** 2).mean(axis=(0, 1)) / (error**2).mean(axis=(0, 1)))
    assert (apart < 0.4).all()  # two seeds of ours differ by 0.2 in rss_2d
