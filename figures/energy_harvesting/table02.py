"""Table II: the parameters of the tracking example, from the log that was simulated with them."""

from repro.plot import style

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = (
    "Table II. Parameters of the tracking example as printed, and as the attachment of the log of "
    "our runs gives them."
)
PRINTED = (
    ("$T$", "sampling_time", 1, "s"),
    ("$N$", "sensors", 4, ""),
    ("$d_0$", "reference_distance", 1, "m"),
    ("$n_r$", "path_loss_exponent", 2, ""),
    (r"$\bar{\gamma}^i$", "saturation_probability", 0.2, ""),
    ("$E_0^i$", "initial_energy", 1, ""),
    (r"$\bar{E}^i$", "energy_capacity", 3, ""),
    (r"$\bar{H}$", "harvest_transition", 3, ""),
    ("$P_0$", "reference_power", 1, "dBm"),
    (r"$\kappa_{\max}$", "saturation_level", 30, "dBm"),
    (r"$\sigma_{\nu,1...4}^2$", "measurement_variances", (0.1, 0.049, 0.064, 0.144), "dBm$^2$"),
    (r"$\sigma_{n,i}^2$", "channel_variance", 0.001, "dBm$^2$"),
    (r"$\Delta$", "acceleration_variance", 0.0016, "m$^2$/s$^4$"),
    ("$MC$", "trials", 100, ""),
)


def said(value) -> str:
    return ", ".join(f"{entry:g}" for entry in (value if isinstance(value, tuple) else (value,)))


def draw(results):
    parameters = results.log("rss_2d", "base").parameters
    ours = parameters | {
        "harvest_transition": len(parameters.harvest_transition) - 1,
        "measurement_variances": tuple(parameters.measurement_variances[: parameters.sensors]),
    }
    rows = [
        (symbol, name, said(printed), said(ours[name]), unit)
        for symbol, name, printed, unit in PRINTED
    ]
    heads = ("symbol", "parameter", "printed", "here", "unit")
    return style.table(rows, heads, widths=(0.14, 0.3, 0.23, 0.23, 0.1))
