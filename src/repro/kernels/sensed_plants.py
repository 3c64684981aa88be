"""The plants that sensors without a steady supply of energy observe [energy_harvesting Sec. IV].

Particles of one trial are (n, particles), a level is (particles,). A loop over particles does one
thing, so that it is vectorised. `growth` and `target` move particles that nothing measures.
"""

from repro.kernels import random
from repro.kernels.compiled import kernel
from repro.kernels.elementary import log_of_normal
from repro.kernels.resampling import total

SQUARED_DISTANCE_FLOOR = 1e-12  # m^2: a target on its sensor has a finite level


@kernel
def growth(keys, k, drive, scale, particles, mean, drawn):
    """Step k of all trials' particles (trials, 1, particles), and their mean (trials, 1)."""
    for trial in range(keys.size):
        x = particles[trial]
        random.fill_uniforms(keys[trial], k, random.MOTION, drawn)
        move_growth(x[0], drawn, drive, scale)
        mean[trial, 0] = total(x[0]) / x.shape[1]


@kernel
def target(keys, k, time, root, particles, mean, drawn):
    """Step k of all trials' particles (trials, n, particles), and their mean (trials, n)."""
    for trial in range(keys.size):
        x = particles[trial]
        random.fill_normals(keys[trial], k, random.MOTION, drawn)
        move_target(x, drawn, time, root)
        for component in range(len(x)):
            mean[trial, component] = total(x[component]) / x.shape[1]


@kernel
def move_growth(x, uniforms, drive, scale):
    """x(k) of (29) over x(k-1), with Gamma noise of shape two: the sum of two exponentials."""
    others = uniforms[x.size :]
    for j in range(x.size):
        last = x[j]
        w = -scale * log_of_normal(uniforms[j] * others[j])
        x[j] = (0.5 * last + 25.0 * last / (1.0 + last * last) + drive) + w


@kernel
def level_growth(x, offset, level):
    """h^i(x) of (29)."""
    for j in range(x.size):
        distance = x[j] - offset
        level[j] = distance * distance * (1 / 20)


@kernel
def move_target(x, normals, time, root):
    """x(k) of (30) over x(k-1), axis by axis."""
    components, count = x.shape
    for axis in range(components // 2):
        of_axis = normals[2 * axis * count : 2 * (axis + 1) * count]
        move_axis(x[2 * axis], x[2 * axis + 1], of_axis, time, root)


@kernel
def move_axis(position, velocity, normals, time, root):
    """x(k) of (30) over x(k-1), of one axis."""
    others = normals[position.size :]
    for j in range(position.size):
        position[j] = position[j] + time * velocity[j] + root[0, 0] * normals[j]
        velocity[j] = velocity[j] + root[1, 0] * normals[j] + root[1, 1] * others[j]


@kernel
def level_signal_strength(x, sensor, level_at_one, slope, level):
    """h^i(x) of (32)."""
    level[:] = 0.0
    for axis in range(sensor.size):
        position, centre = x[2 * axis], sensor[axis]
        for j in range(level.size):
            offset = position[j] - centre
            level[j] += offset * offset
    for j in range(level.size):
        squared = SQUARED_DISTANCE_FLOOR if level[j] < SQUARED_DISTANCE_FLOOR else level[j]
        level[j] = level_at_one + slope * log_of_normal(squared)
