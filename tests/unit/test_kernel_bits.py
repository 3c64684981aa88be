"""The kernels give the same bytes on every CPU: others are imitated, one a process."""

import hashlib
import os
import subprocess
import sys

import numpy as np
import pytest
from llvmlite.binding import get_host_cpu_features

from repro.filters.families import ross_eh
from repro.kernels import arrays, random
from repro.models.rss import SignalStrength
from repro.models.sensor_network import ExponentialNoise, GaussianNoise, SensorNetwork
from repro.models.ungm import Growth
from repro.network.saturation import Saturation
from repro.parameters.settings import Bootstrap
from repro.runner import run
from repro.streams import Streams
from tests.conftest import small_log

TRIALS, STEPS = 3, 20
WANTED = "cb3b57eaaa96461c2749b53259d84845"
SIMULATED = (("deadband", "mapf"), ("saturation", "mpf"), ("ungm", "pf_ross_eh_joint"))
ENVIRONMENTS = {
    "generic": {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""},
    "haswell": {"NUMBA_CPU_NAME": "haswell", "NUMBA_CPU_FEATURES": "+avx2,+fma,+bmi,+bmi2"},
}


def digest() -> str:
    """Of functions, random numbers, filters, and simulated logs."""
    total = hashlib.sha256()
    keys = Streams(5, "bits", "filter:test", range(TRIALS)).keys()
    values = np.empty((TRIALS, 4000))
    random.normals_of(keys, 1, random.MOTION, values)
    total.update(values.tobytes())
    for function in (arrays.exp, arrays.sin, arrays.cos, arrays.expm1, arrays.log_normal_cdf):
        total.update(function(10 * values).tobytes())
    for function in (arrays.log, arrays.log10, arrays.log1p):
        total.update(function(np.abs(values)).tobytes())
    for function in (arrays.arctan2, arrays.hypot, arrays.logaddexp):
        total.update(function(values[0], values[1]).tobytes())
    for model in (growth(), signal_strength()):
        for scheme in ("systematic", "multinomial"):
            total.update(estimates(model, scheme).tobytes())
    for study, name in SIMULATED:
        log = small_log(study, "base")
        for values in log.values.values():
            total.update(values.tobytes())
        total.update(run(log, name, {"particles": 103})[0].tobytes())
    return total.hexdigest()


def growth() -> SensorNetwork:
    return SensorNetwork(
        initial_mean=np.zeros(1),
        sensors=2,
        steps=STEPS,
        draw_prior=lambda streams, particles: streams.standard_normal(1, particles),
        plant=Growth(2.0, (0.1, -0.1)),
        noise=ExponentialNoise(2.0, 2),
        saturation=Saturation(0.5, 10.0),
    )


def signal_strength() -> SensorNetwork:
    return SensorNetwork(
        initial_mean=np.zeros(4),
        sensors=2,
        steps=STEPS,
        draw_prior=lambda streams, particles: streams.standard_normal(4, particles),
        noise=GaussianNoise(np.array([0.1, 0.1]), 0.001),
        saturation=Saturation(0.2, 30.0),
        plant=SignalStrength(
            1.0,
            np.array([[0.5, 0.0], [0.4, 0.3]]),
            np.array([[-5.0, 3.0], [6.0, -2.0]]),
            -10.0,
            3.0,
            1.0,
        ),
    )


def estimates(model: SensorNetwork, scheme: str) -> np.ndarray:
    settings = Bootstrap(particles=103, resampling=scheme, weights="logarithmic")
    filter_ = ross_eh.build(model, settings, saturates=True, transmission=None)
    streams = Streams(5, "bits", "filter:test", range(TRIALS))
    state, found = filter_.init(streams), []
    z = np.empty((TRIALS, 4 * STEPS))
    random.normals_of(streams.keys(), 0, random.ARRIVALS, z)
    for k in range(1, STEPS + 1):
        received = 4.0 + z[:, 4 * (k - 1) : 4 * (k - 1) + 2]
        if isinstance(model.noise, GaussianNoise):
            received = received - 32.0
        state = filter_.step(state, k, Seen(received))
        found.append(filter_.mean(state))
    return np.stack(found)


class Seen:
    def __init__(self, received: np.ndarray):
        self.received = received


def test_the_bytes_of_this_cpu():
    assert digest()[:32] == WANTED


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_the_bytes_of_another_cpu(name):
    if name == "haswell" and not get_host_cpu_features().get("avx2"):
        pytest.skip("this CPU cannot run such code")
    run = subprocess.run(
        [sys.executable, "-c", "from tests.unit.test_kernel_bits import digest; print(digest())"],
        env=os.environ | ENVIRONMENTS[name] | {"PYTHONPATH": os.pathsep.join(["src", "."])},
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stdout.strip()[:32] == WANTED
