"""The paper's symbols of parameters [energy_harvesting Tables I and II]."""

from typing import NamedTuple


class Symbol(NamedTuple):
    """How the paper writes a parameter, what it is, and its unit."""

    text: str
    meaning: str
    unit: str = ""


SYMBOLS = {
    "sensor_positions": Symbol("$s_x^{s,i}, s_y^{s,i}$", "position of sensor i", "m"),
    "sampling_time": Symbol("$T$", "sampling period", "s"),
    "acceleration_variance": Symbol(r"$\Delta$", "variance of acceleration", "m$^2$/s$^4$"),
    "sensors": Symbol("$N$", "number of sensors"),
    "saturation_level": Symbol(r"$\kappa_{\max}$", "level of saturation", "dBm"),
    "reference_power": Symbol("$P_0$", "level at the distance $d_0$", "dBm"),
    "reference_distance": Symbol("$d_0$", "reference distance", "m"),
    "path_loss_exponent": Symbol("$n_r$", "path loss exponent"),
    "measurement_variances": Symbol(r"$\sigma_{\nu,i}^2$", "noise of the sensors", "dBm$^2$"),
    "channel_variance": Symbol(r"$\sigma_{n,i}^2$", "noise of the channels", "dBm$^2$"),
    "saturation_probability": Symbol(r"$\bar{\gamma}^i$", "probability of saturation"),
    "initial_energy": Symbol("$E_0^i$", "energy at k = 0"),
    "energy_capacity": Symbol(r"$\bar{E}^i$", "largest energy"),
    "harvest_transition": Symbol(r"$\bar{H}, \Pi_1, \Pi_2$", "harvest's transition matrix"),
    "trials": Symbol("$MC$", "number of runs"),
}
