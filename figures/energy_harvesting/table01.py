"""Table I: the symbols of the tracking examples, with the names that the project gives them."""

from repro.plot import style

NEEDS = {}
CAPTION = "Table I. The paper's symbols and what stands for them here."
ROWS = (
    (r"$s_x^t, s_y^t$", "true position, m", "/truth: s_x, s_y"),
    (r"$v_x^t, v_y^t$", "true velocity, m/s", "/truth: v_x, v_y"),
    (r"$s^{t,j}, v^{t,j}$", "the same in run j", "trial j of /truth"),
    (r"$\hat{s}^{t,j}, \hat{v}^{t,j}$", "their estimates in run j", "/truth + error of the runs"),
    (r"$s_x^{s,i}, s_y^{s,i}$", "position of sensor i, m", "sensor_positions"),
    (r"$T$", "sampling period, s", "sampling_time"),
    (r"$\Delta$", "variance of the acceleration, m$^2$/s$^4$", "acceleration_variance"),
    (r"$N$", "number of sensors", "sensors"),
    (r"$\kappa_{\max}$", "level of saturation, dBm", "saturation_level"),
    (
        r"$P_0, d_0$",
        "level (dBm) at a distance (m)",
        "reference_power, reference_distance",
    ),
    (r"$n_r$", "path loss exponent", "path_loss_exponent"),
    (
        r"$\sigma_{\nu,i}^2, \sigma_{n,i}^2$",
        "noise of sensor, of channel, dBm$^2$",
        "measurement_variances, channel_variance",
    ),
    (r"$\bar{\gamma}^i$", "probability of saturation", "saturation_probability"),
    (r"$E_0^i, \bar{E}^i$", "energy at k = 0, largest energy", "initial_energy, energy_capacity"),
    (r"$\bar{H}, \Pi_1, \Pi_2$", "largest harvest, its transition", "harvest_transition"),
    (r"$MC, M$", "runs, particles", "trials, particles"),
)


def draw(results):
    return style.table(ROWS, ("symbol", "meaning", "here"), widths=(0.16, 0.4, 0.44))
