"""Table I: the symbols of the tracking examples, with the names and values that they have here."""

from repro.plot import style

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = (
    "Table I. The paper's symbols, what stands for them here, and the values of the base point."
)
SHOWN = 24  # letters of a value that a cell holds
ROWS = (
    (r"$s_x^t, s_y^t$", "true position, m", "/truth: s_x, s_y"),
    (r"$v_x^t, v_y^t$", "true velocity, m/s", "/truth: v_x, v_y"),
    (r"$s^{t,j}, v^{t,j}$", "the same in run j", "trial j of /truth"),
    (r"$\hat{s}^{t,j}, \hat{v}^{t,j}$", "their estimates in run j", "/truth + error of a run"),
    (r"$s_x^{s,i}, s_y^{s,i}$", "position of sensor i, m", "sensor_positions"),
    (r"$T$", "sampling period, s", "sampling_time"),
    (r"$\Delta$", "variance of acceleration, m$^2$/s$^4$", "acceleration_variance"),
    (r"$N$", "number of sensors", "sensors"),
    (r"$\kappa_{\max}$", "level of saturation, dBm", "saturation_level"),
    (r"$P_0$", "level at the distance $d_0$, dBm", "reference_power"),
    (r"$d_0$", "reference distance, m", "reference_distance"),
    (r"$n_r$", "path loss exponent", "path_loss_exponent"),
    (r"$\sigma_{\nu,i}^2$", "noise of the sensors, dBm$^2$", "measurement_variances"),
    (r"$\sigma_{n,i}^2$", "noise of the channels, dBm$^2$", "channel_variance"),
    (r"$\bar{\gamma}^i$", "probability of saturation", "saturation_probability"),
    (r"$E_0^i$", "energy at k = 0", "initial_energy"),
    (r"$\bar{E}^i$", "largest energy", "energy_capacity"),
    (r"$\bar{H}, \Pi_1, \Pi_2$", "harvest's transition matrix", "harvest_transition"),
    (r"$MC$", "number of runs", "trials"),
)


def draw(results):
    parameters = results.log("rss_2d", "base").parameters
    rows = []
    for symbol, meaning, name in ROWS:
        # Other names are of topics; a name that no parameter has is a fault
        value = "" if "/" in name else str(parameters[name])
        rows.append((symbol, meaning, name, value[:SHOWN] + "..." * (len(value) > SHOWN)))
    return style.table(rows, ("symbol", "meaning", "here", "value"), (0.14, 0.34, 0.27, 0.25))
