"""What the tracking studies of Song et al., Sec. IV-B, share in two and three dimensions."""

import numpy as np

from repro.kernels.normals import standard_normal
from repro.models import rss
from repro.models.sensor_network import GaussianNoise, SensorNetwork
from repro.studies.families import harvesting_sensors

LOST_ABOVE = 10.0  # m, rms position error over the last LAST_STEPS steps
LAST_STEPS = 10


def state(dimensions: int) -> tuple[str, ...]:
    return tuple(f"{kind}_{axis}" for axis in "xyz"[:dimensions] for kind in ("s", "v"))


def components(dimensions: int) -> dict[str, range]:
    return {
        "position": range(0, 2 * dimensions, 2),
        "velocity": range(1, 2 * dimensions, 2),
    }


def noise(parameters: dict) -> GaussianNoise:
    variances = np.array(parameters["measurement_variances"][: parameters["sensors"]])
    return GaussianNoise(variances, parameters["channel_variance"])


def positions(parameters: dict) -> np.ndarray:
    """Positions of the sensors in use, (N, axes), in m."""
    return np.array(parameters["sensor_positions"], dtype=float)[: parameters["sensors"]]


def level(parameters: dict, x: np.ndarray, i: int) -> np.ndarray:
    """h^i(x) in dBm of states (trials, n, ...)."""
    return rss.level(
        x,
        positions(parameters)[i],
        parameters["reference_power"],
        parameters["path_loss_exponent"],
        parameters["reference_distance"],
    )


def simulate(parameters: dict, streams) -> dict[str, np.ndarray]:
    steps, n = parameters["steps"], len(parameters["true_initial_state"])
    time, root = _motion(parameters)
    normals = streams("process").standard_normal(steps, n)
    truth = np.empty((len(normals), n, steps + 1))
    truth[:, :, 0] = parameters["true_initial_state"]
    for k in range(steps):
        truth[:, :, k + 1] = rss.move(truth[:, :, k].copy(), normals[:, k], time, root)
    sensors = range(parameters["sensors"])
    levels = np.stack([level(parameters, truth, i) for i in sensors], axis=1)
    return harvesting_sensors.measured(
        np.moveaxis(truth, 1, -1), levels, parameters, noise(parameters), streams
    )


def saturated(log, i: int) -> np.ndarray:
    """Where the output of sensor i is saturated, gamma = 1 and |h| > kappa, (trials, steps + 1)."""
    levels = level(log.parameters, np.moveaxis(log.values["/truth"], 2, 1), i)
    gamma = log.field("/network", f"saturation_{i + 1}")
    return (gamma == 1) & (np.abs(levels) > log.parameters["saturation_level"])


def model(parameters: dict, draw_prior) -> SensorNetwork:
    time, root = _motion(parameters)
    initial = np.array(parameters["true_initial_state"], dtype=float)

    def move(x, k, streams):
        return rss.move(x, standard_normal(streams, *x.shape[1:]), time, root)

    return SensorNetwork(
        initial_mean=initial,
        sensors=parameters["sensors"],
        steps=parameters["steps"],
        draw_prior=draw_prior,
        move=move,
        level=lambda x, i: level(parameters, x, i),
        noise=noise(parameters),
        saturation=harvesting_sensors.saturation_of(parameters),
        energy=harvesting_sensors.queue(parameters),
    )


def _motion(parameters: dict) -> tuple[float, np.ndarray]:
    time = parameters["sampling_time"]
    return time, rss.process_root(time, parameters["acceleration_variance"])


def lost(runs) -> np.ndarray:
    """Which runs have lost the target, (trials,)."""
    axes = range(0, runs.error.shape[-1], 2)
    last = harvesting_sensors.squared(runs, axes)[:, -LAST_STEPS:]
    return np.sqrt(last.mean(axis=1)) > LOST_ABOVE
