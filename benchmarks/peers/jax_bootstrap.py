"""The bootstrap filters of `ungm` and `rss_2d` in JAX on the CPU.

For benchmarks/particle_filters.py. Jitted, a batch of trials side by side, jax.lax.scan over the
steps, float64, random numbers of jax.random, systematic resampling at every step, the likelihood
(27) of PF-ROSS-EH. Of the forms tried (vmap, batches of 1 to 200, searchsorted by any method, other
generators, Box-Muller) this is the fastest.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from repro import plugins
from repro.logs import Log
from repro.network.energy_harvesting import transmission_probability

jax.config.update("jax_enable_x64", True)
TRIALS_AT_ONCE = 100
UNDERFLOWS = 1e-200  # sum of likelihoods, below which they are taken in logarithms
SQUARED_DISTANCE_FLOOR = 1e-12  # m^2


def bootstrap(
    log: Log, count: int, trials: int, normals: Any = jnp.float64
) -> Callable[[], np.ndarray]:
    """A function that filters the first trials and returns estimates of k = 1 ..., (trials, K, n).

    Its first call compiles it. `normals` is the type in which they are drawn: in float64 a normal
    takes JAX three times as long as in float32.
    """
    model = plugins.study(log.study).model(log.parameters)
    transmission = transmission_probability(model.energy, model.steps, "lemma1")[1:]
    initial, move, weights = {"ungm": _growth, "rss_2d": _tracking}[log.study](
        log.parameters, model, partial(_normal, normals, count)
    )
    steps = jnp.arange(1, model.steps + 1)

    @jax.jit
    def filtered(key: jax.Array, z: jax.Array) -> jax.Array:
        """Estimates (K, n, trials) from measurements (K, sensors, trials)."""
        of_prior, of_steps = jax.random.split(key)

        def step(cloud, known):
            k, sends, received, of_step = known
            of_parents, of_motion = jax.random.split(of_step)
            x, w = cloud
            chosen = systematic(w, jax.random.uniform(of_parents, (len(w),)))
            x = [jnp.take_along_axis(of_x, chosen, 1, mode="promise_in_bounds") for of_x in x]
            x = move(x, k, of_motion)
            w = weights(x, received, sends)
            return (x, w), jnp.stack([(w * component).sum(axis=1) for component in x])

        batch = z.shape[-1]
        cloud = initial(of_prior, batch), jnp.full((batch, count), 1.0 / count)
        known = steps, jnp.asarray(transmission), z, jax.random.split(of_steps, model.steps)
        return jax.lax.scan(step, cloud, known)[1]

    received = np.moveaxis(log.values["/received"][:trials, 1:], 0, -1)
    firsts = range(0, trials, TRIALS_AT_ONCE)
    parts = [jnp.asarray(received[..., i : i + TRIALS_AT_ONCE]) for i in firsts]
    keys = jax.random.split(jax.random.key(log.seed), len(parts))

    def run() -> np.ndarray:
        found = [np.asarray(filtered(*of_part)) for of_part in zip(keys, parts, strict=True)]
        return np.moveaxis(np.concatenate(found, axis=-1), -1, 0)

    return run


def systematic(w: jax.Array, uniforms: jax.Array) -> jax.Array:
    """Parents (trials, particles): as many as the weights below it leave of the grid's points."""
    count = w.shape[1]
    below = jnp.ceil(count * jnp.cumsum(w, axis=1) - uniforms[:, None]).astype(jnp.int32)
    zeros = jnp.zeros(count, jnp.int32)
    steps = jax.vmap(lambda at: zeros.at[at].add(1, mode="drop"))(below)
    return jnp.minimum(jnp.cumsum(steps, axis=1), count - 1)


def _normal(normals: Any, count: int, key: jax.Array, *shape: int) -> jax.Array:
    return jax.random.normal(key, (*shape, count), normals).astype(jnp.float64)


def _normalised(likelihood: jax.Array) -> jax.Array:
    """Weights; equal ones where nothing explains the measurement."""
    total = likelihood.sum(axis=1, keepdims=True)
    equal = 1.0 / likelihood.shape[1]
    return jnp.where(total > 0, likelihood / jnp.where(total > 0, total, 1.0), equal)


def _growth(p: Any, model: Any, normal: Callable) -> tuple[Callable, Callable, Callable]:
    """[energy_harvesting (29)]: prior, transition, weights."""
    rate, (gbar, limit) = 1.0 / p.noise_mean, model.saturation

    def initial(key, batch):
        return [p.prior_mean + np.sqrt(p.prior_variance) * normal(key, batch)]

    def move(x, k, key):
        (last,) = x
        first, second = 1.0 - jax.random.uniform(key, (2, *last.shape))
        w = -p.process_noise_scale * jnp.log(first * second)  # Gamma of shape two
        return [0.5 * last + 25.0 * last / (1.0 + last * last) + 8.0 * jnp.cos(1.2 * (k - 1)) + w]

    def erlang(error):
        error = jnp.maximum(error, 0.0)
        return rate * rate * error * jnp.exp(-rate * error)

    def weights(x, z, sends):
        total = 1.0
        for offset, received in zip(p.sensor_offsets, z[:, :, None], strict=True):
            h = (x[0] - offset) ** 2 / 20
            lost = (1 - sends) * jnp.where(received >= 0, rate * jnp.exp(-rate * received), 0.0)
            high = sends * gbar * erlang(received - limit) + lost
            beyond = h > limit  # h is not negative
            factor = sends * jnp.where(beyond, 1 - gbar, 1.0)
            total = total * (factor * erlang(received - h) + jnp.where(beyond, high, lost))
        return _normalised(total)

    return initial, move, weights


def _tracking(p: Any, model: Any, normal: Callable) -> tuple[Callable, Callable, Callable]:
    """[energy_harvesting (30)-(32)]: prior, transition, weights."""
    plant, (gbar, limit) = model.plant, model.saturation
    (r00, _), (r10, r11) = plant.root
    slope = -5.0 * plant.exponent / np.log(10.0)
    at_one = plant.power - 2.0 * slope * np.log(plant.reference)
    variances = model.noise.measurement_variances + model.noise.channel_variance

    def initial(key, batch):
        (x, v_x, y, v_y), drawn = p.true_initial_state, normal(key, 4, batch)
        speed = np.hypot(v_x, v_y) + np.sqrt(p.prior_speed_variance) * drawn[1]
        azimuth = np.arctan2(v_y, v_x) + np.sqrt(p.prior_azimuth_variance) * drawn[3]
        x, y = (c + np.sqrt(p.prior_position_variance) * drawn[i] for c, i in ((x, 0), (y, 2)))
        return [x, speed * jnp.cos(azimuth), y, speed * jnp.sin(azimuth)]

    def move(x, k, key):
        drawn = normal(key, 4, len(x[0]))
        moved = []
        for axis in (0, 2):
            moved += [x[axis] + plant.time * x[axis + 1] + r00 * drawn[axis]]
            moved += [x[axis + 1] + r10 * drawn[axis] + r11 * drawn[axis + 1]]
        return moved

    def log_normal(error, variance):
        return -0.5 * (error * error / variance + np.log(2 * np.pi * variance))

    def weights(x, z, sends):
        terms = []  # of each sensor: its error, its variance, and what is chosen by the level
        for received, variance, sensor in zip(z[:, :, None], variances, plant.sensors, strict=True):
            squared = (x[0] - sensor[0]) ** 2 + (x[2] - sensor[1]) ** 2
            h = at_one + slope * jnp.log(jnp.maximum(squared, SQUARED_DISTANCE_FLOOR))
            lost = jnp.log(1 - sends) + log_normal(received, model.noise.channel_variance)
            low, high = (
                jnp.logaddexp(lost, jnp.log(sends * gbar) + log_normal(received - at, variance))
                for at in (-limit, limit)
            )
            terms.append((received - h, variance, h < -limit, h > limit, lost, low, high))

        def chosen(below, above, between, if_below, if_above):
            return jnp.where(below, if_below, jnp.where(above, if_above, between))

        def products():
            total = 1.0
            for error, variance, below, above, *rest in terms:
                peak = sends / np.sqrt(2 * np.pi * variance)
                factor = jnp.where(below | above, (1 - gbar) * peak, peak)
                other = chosen(below, above, *map(jnp.exp, rest))
                total = total * (factor * jnp.exp(-0.5 / variance * error * error) + other)
            return total

        def in_logarithms():
            total = 0.0
            for error, variance, below, above, *rest in terms:
                clear = jnp.where(below | above, np.log(1 - gbar), 0.0)
                sent = jnp.log(sends) + clear + log_normal(error, variance)
                total = total + jnp.logaddexp(sent, chosen(below, above, *rest))
            return jnp.exp(total - total.max(axis=1, keepdims=True))

        total = products()
        underflows = (total.sum(axis=1) < UNDERFLOWS).any()
        return _normalised(jax.lax.cond(underflows, in_logarithms, lambda: total))

    return initial, move, weights
