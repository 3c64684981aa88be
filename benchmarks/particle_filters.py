"""CPU time of the particle kernels: in the papers' filters, and beside the library `particles`.

    python benchmarks/particle_filters.py

The library needs the `bench` extra and `pip install --no-deps -r
benchmarks/requirements-particles.txt`, a file that says why.

The common problem: bootstrap filter with systematic resampling at every step, four states at
constant velocity, four signal-strength sensors with Gaussian noise. Same data, same model.
"""

import _as_in_jobs  # noqa: F401  # isort: skip

import sys
from collections.abc import Callable
from pathlib import Path
from time import process_time
from types import SimpleNamespace
from typing import Any

import numpy as np

from repro.filters.families import ross_eh
from repro.models.rss import SignalStrength
from repro.models.sensor_network import GaussianNoise, SensorNetwork
from repro.parameters.load import load_paper
from repro.parameters.settings import Bootstrap
from repro.runner import run
from repro.simulate import simulated
from repro.streams import Streams

ROOT = Path(__file__).parent.parent
LIMITS = {"mapf": 80.0, "mapf_nc": 80.0, "mapf_nmc": 80.0, "mpf": 45.0}  # ns
AT_LEAST = 3.0  # times faster than the library
PARTICLES, STEPS, TRIALS, BLOCK = 500, 100, 100, 10
SENSORS = np.array([[0.0, 0.0], [100.0, 0.0], [0.0, 100.0], [100.0, 100.0]])
TRANSITION = np.eye(4) + np.diag([1.0, 1.0], 2)  # px, py, vx, vy; a step is 1 s
NOISE = np.array([0.1, 0.1, 0.05, 0.05])
START, SPREAD = np.array([20.0, 30.0, 0.5, 0.3]), np.array([2.0, 2.0, 0.2, 0.2])


def data() -> np.ndarray:
    """Received strengths, (trials, steps, sensors), in dB with noise of 1 dB."""
    rng = np.random.default_rng(1)
    x = START + SPREAD * rng.standard_normal((TRIALS, 4))
    y = np.empty((TRIALS, STEPS, len(SENSORS)))
    for k in range(STEPS):
        x = x @ TRANSITION.T + NOISE * rng.standard_normal(x.shape)
        distance = np.hypot(*np.moveaxis(x[:, None, :2] - SENSORS, -1, 0))
        y[:, k] = 10 - 20 * np.log10(distance) + rng.standard_normal((TRIALS, len(SENSORS)))
    return y


def ours(y: np.ndarray, seed: int = 1) -> np.ndarray:
    """Estimates (trials, steps, 4) of the project's kernel."""
    paired = [0, 2, 1, 3]  # its states are px, vx, py, vy
    mean, deviation = START[paired, None], SPREAD[paired, None]
    model = SensorNetwork(
        initial_mean=START[paired],
        sensors=len(SENSORS),
        steps=STEPS,
        draw_prior=lambda streams, count: mean + deviation * streams.standard_normal(4, count),
        plant=SignalStrength(1.0, np.diag(NOISE[[0, 2]]), SENSORS, 10.0, 2.0, 1.0),
        noise=GaussianNoise(np.full(len(SENSORS), 0.5), 0.5),
    )
    settings = Bootstrap(particles=PARTICLES, resampling="systematic", weights="logarithmic")
    filter_ = ross_eh.build(model, settings, saturates=False, transmission=None)
    estimates = np.empty((TRIALS, STEPS, 4))
    for first in range(0, TRIALS, BLOCK):
        block = slice(first, first + BLOCK)
        state = filter_.init(Streams(seed, "benchmark", "filter:sir", range(first, first + BLOCK)))
        for k in range(STEPS):
            state = filter_.step(state, k + 1, SimpleNamespace(received=y[block, k]))
            estimates[block, k] = filter_.mean(state)[:, paired]
    return estimates


def of_the_library(y: np.ndarray) -> np.ndarray:
    """Estimates (trials, steps, 4) of the library `particles`."""
    import particles
    from particles import distributions as dists
    from particles import state_space_models as ssm
    from particles.collectors import Moments

    class Tracking(ssm.StateSpaceModel):
        def _move(self, x, scale):
            moved = (x[:, 0] + x[:, 2], x[:, 1] + x[:, 3], x[:, 2], x[:, 3])
            return dists.IndepProd(
                *(dists.Normal(loc=m, scale=s) for m, s in zip(moved, scale, strict=True))
            )

        def PX0(self):  # of step 1: it has no transition before its first measurement
            cov = TRANSITION @ np.diag(SPREAD**2) @ TRANSITION.T + np.diag(NOISE**2)
            return dists.MvNormal(loc=TRANSITION @ START, cov=cov)

        def PX(self, t, xp):
            return self._move(xp, NOISE)

        def PY(self, t, xp, x):
            squared = ((x[:, None, :2] - SENSORS) ** 2).sum(axis=-1)
            mean = 10 - 10 * np.log10(squared)
            return dists.IndepProd(*(dists.Normal(loc=m, scale=1.0) for m in mean.T))

    estimates = np.empty((len(y), STEPS, 4))
    for trial, received in enumerate(y):
        algorithm = particles.SMC(
            fk=ssm.Bootstrap(ssm=Tracking(), data=received[:, None]),
            N=PARTICLES,
            resampling="systematic",
            ESSrmin=1.0,
            collect=[Moments()],
        )
        algorithm.run()
        estimates[trial] = [moments["mean"] for moments in algorithm.summaries.moments]
    return estimates


def bound() -> None:
    """The normals, logarithms and exponentials that no bootstrap filter of this problem avoids."""
    generator = np.random.Generator(np.random.PCG64(1))
    normals = np.empty((BLOCK, 4, PARTICLES))
    distances = np.ones((BLOCK, len(SENSORS), PARTICLES))
    weights = np.zeros((BLOCK, PARTICLES))
    for _ in range(TRIALS // BLOCK * STEPS):
        generator.standard_normal(out=normals)
        np.log(distances, out=distances)
        np.exp(weights, out=weights)
        distances[:], weights[:] = 1.0, 0.0


def timed(work: Callable[..., Any], *arguments: Any) -> tuple[float, Any]:
    """The shortest CPU time of three, in seconds, and the result."""
    times = []
    for _ in range(3):
        start = process_time()
        result = work(*arguments)
        times.append(process_time() - start)
    return min(times), result


def beside_the_library() -> bool:
    y = data()
    each = TRIALS * STEPS * PARTICLES / 1e9
    floor, _ = timed(bound)
    mine, first = timed(ours, y)
    print(f"bootstrap, 4 states, 4 sensors: {mine / each:.0f} ns a particle and step")
    print(f"  its normals, log and exp: {floor / each:.0f} ns; the kernel takes {mine / floor:.1f}")
    try:
        of_the_library(y[:1])  # compiles
    except ImportError as error:
        print(f"  the library is not installed ({error})")
        return False
    theirs, second = timed(of_the_library, y)
    apart, among_ours = (
        np.sqrt(((first - other)[..., :2] ** 2).sum(axis=-1).mean())
        for other in (second, ours(y, seed=2))
    )
    print(f"  particles: {theirs / each:.0f} ns, {theirs / mine:.1f} times as much")
    print(f"  estimates differ by {apart:.2f} m rms; two of ours by {among_ours:.2f} m")
    return theirs >= AT_LEAST * mine


def in_the_filters(trials: int = 24) -> bool:
    paper = load_paper(ROOT / "params" / "censored_network.yaml")
    fast = True
    for study, points in paper.studies.items():
        base = points["base"]
        log = simulated(study, "base", base.parameters, 1, np.arange(trials))
        for name, limit in LIMITS.items():
            seconds, _ = timed(run, log, name, base.filters[name])
            each = trials * base.parameters.steps * 3 * base.filters[name]["particles"] / 1e9
            took = seconds / each
            print(f"{study}, {name}: {took:.0f} ns a particle, node and step; at most {limit:.0f}")
            fast &= took <= limit
    return fast


if __name__ == "__main__":
    sys.exit(0 if in_the_filters() & beside_the_library() else 1)
