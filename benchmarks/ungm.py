"""CPU time of PF-ROSS-EH a particle and step, and on `ungm` beside the library `particles`.

    python benchmarks/ungm.py

The library needs the `bench` extra and `pip install --no-deps -r
benchmarks/requirements-particles.txt`, a file that says why. Both run the
bootstrap filter with systematic resampling at every step and the likelihood of
[energy_harvesting (27)] on the same data.
"""

import _as_in_jobs  # noqa: F401  # isort: skip

import sys
from collections.abc import Callable
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

from repro import plugins
from repro.logs import Log
from repro.models import ungm
from repro.network.energy_harvesting import transmission_probability
from repro.parameters.load import load_paper
from repro.runner import run
from repro.simulate import simulated

ROOT = Path(__file__).parent.parent
LIMITS = {"ungm": 40.0, "rss_2d": 110.0}  # ns
TRIALS = {"ungm": 1000, "rss_2d": 100}
AT_LEAST = 3.0  # times faster than the library


def timed(work: Callable[..., Any], *arguments: Any) -> tuple[float, Any]:
    """The shortest CPU time of five, in seconds, and the result."""
    times = []
    for _ in range(5):
        start = process_time()
        result = work(*arguments)
        times.append(process_time() - start)
    return min(times), result


def of_the_library(log: Log, particles: int, trials: int) -> np.ndarray:
    """Estimates (trials, steps) of the library `particles`."""
    import particles as library
    from particles import distributions as dists
    from particles import state_space_models as ssm
    from particles.collectors import Moments

    parameters = log.parameters
    model = plugins.study("ungm").model(parameters)
    transmission = transmission_probability(model.energy, model.steps, "lemma1")

    class Moved(dists.ProbDist):
        def __init__(self, x, t):
            self.x, self.t = x, t

        def rvs(self, size=None):
            w = np.random.gamma(2.0, parameters.process_noise_scale, size)  # noqa: NPY002
            return ungm.transition(self.x, self.t) + w

    class Received(dists.ProbDist):
        def __init__(self, x, t):
            self.x, self.t = x, t

        def logpdf(self, z):
            total, sends, mean = 0.0, transmission[self.t + 1], parameters.noise_mean
            gbar, limit = model.saturation
            for offset, received in zip(parameters.sensor_offsets, z, strict=True):
                level = ungm.level(self.x, offset)
                clear, clipped = (
                    np.maximum(received - h, 0.0) for h in (level, np.minimum(level, limit))
                )
                sent = (1 - gbar) * clear * np.exp(-clear / mean)
                sent += gbar * clipped * np.exp(-clipped / mean)
                lost = np.exp(-received / mean) / mean if received >= 0 else 0.0
                total = total + np.log(sends * sent / mean**2 + (1 - sends) * lost)
            return total

    class Scalar(ssm.StateSpaceModel):
        def PX0(self):  # the library has no step before its first measurement
            x0 = np.random.normal(  # noqa: NPY002
                parameters.prior_mean, np.sqrt(parameters.prior_variance), particles
            )
            return Moved(x0, 0)

        def PX(self, t, xp):
            return Moved(xp, t)

        def PY(self, t, xp, x):
            return Received(x, t)

    estimates = []
    for received in log.values["/received"][:trials, 1:]:
        algorithm = library.SMC(
            fk=ssm.Bootstrap(ssm=Scalar(), data=list(received)),
            N=particles,
            resampling="systematic",
            ESSrmin=1.0,
            collect=[Moments()],
        )
        algorithm.run()
        estimates.append([moments["mean"] for moments in algorithm.summaries.moments])
    return np.array(estimates)


def main() -> bool:
    paper = load_paper(ROOT / "params" / "energy_harvesting.yaml")
    fast, took = True, {}
    for study, limit in LIMITS.items():
        base, trials = paper.studies[study]["base"], TRIALS[study]
        log = simulated(study, "base", base.parameters, 1, np.arange(trials))
        settings = base.filters["pf_ross_eh"]
        seconds, (estimate, _) = timed(run, log, "pf_ross_eh", settings)
        each = trials * base.parameters.steps * settings["particles"] / 1e9
        took[study] = (seconds / each, log, estimate)
        print(f"{study}: {seconds / each:.0f} ns a particle and step; at most {limit:.0f}")
        fast &= seconds <= limit * each
    ours, log, estimate = took["ungm"]
    particles = paper.studies["ungm"]["base"].filters["pf_ross_eh"]["particles"]
    trials = 50
    try:
        of_the_library(log, particles, 1)  # compiles
    except ImportError as error:
        print(f"  the library is not installed ({error})")
        return False
    seconds, theirs = timed(of_the_library, log, particles, trials)
    each = trials * log.parameters.steps * particles / 1e9
    print(f"  particles: {seconds / each:.0f} ns, {seconds / each / ours:.1f} times as much")
    errors = [
        np.sqrt(((x - log.values["/truth"][:trials, 1:, 0]) ** 2).mean())
        for x in (estimate[:trials, 1:, 0], theirs)
    ]
    print(f"  rms error of x over {trials} runs: {errors[0]:.2f} here, {errors[1]:.2f} there")
    return fast and seconds / each >= AT_LEAST * ours


if __name__ == "__main__":
    sys.exit(0 if main() else 1)
