"""Figures 2-13 of Song et al.: one run, and RMSE over k with its band."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro import plugins
from repro.network import energy_harvesting
from repro.plot import style
from repro.studies.families import harvesting_sensors, signal_strength
from repro.tables.results import Results

BAND = 2  # standard errors either side
RUN = 0  # the run that the figures of one run show: the first, whatever it looks like
UNITS = {"position": "m", "velocity": "m/s"}
SENSOR = 4  # of Figs. 4 and 5
NOT_SHOWN = {"pf_ross", "pf_eh", "spf_im", "pf_ross_eh_exact", "pf_ross_eh_joint"}


class Curve(NamedTuple):
    label: str
    point: str
    filter: str
    look: dict


def all_filters(results: Results, study: str) -> list[Curve]:
    """Every filter that runs on the study's base point."""
    return [
        Curve(style.label(f), "base", f, style.look(results.catalogue, study, f))
        for f in results.filters(study, "base")
    ]


def over_points(labels: dict[str, str]) -> list[Curve]:
    """PF-ROSS-EH at several points, given with their labels."""
    return [
        Curve(label, point, "pf_ross_eh", {"color": colour})
        for (point, label), colour in zip(labels.items(), style.COLOURS, strict=False)
    ]


def rmse_over_k(axes: Axes, results: Results, study: str, component: str, curves: list) -> None:
    """RMSE(k) with its Monte Carlo band, the median error of a run, and open-loop prediction."""
    table = results.curves(study)
    table = table[(table["component"] == component) & (table["k"] > 0)]
    lowest = table.loc[table["point"].isin([curve.point for curve in curves]), "median"].min()
    for curve in curves:
        rows = table[(table["point"] == curve.point) & (table["filter"] == curve.filter)]
        look = {key: value for key, value in curve.look.items() if key == "color"}
        axes.plot(rows["k"], rows["value"], lw=1.4, label=curve.label, **look)
        axes.plot(rows["k"], rows["median"], lw=0.9, ls=":", **look)
        axes.fill_between(
            rows["k"],
            np.maximum(rows["value"] - BAND * rows["mcse"], 1e-3),
            rows["value"] + BAND * rows["mcse"],
            alpha=0.2,
            lw=0,
            **look,
        )
    parameters = results.log(study, "base").parameters
    k = np.arange(1, parameters.steps + 1)
    axes.plot(k, prediction(study, parameters, component, k), color="0.55", lw=1.2, label="no data")
    axes.set(
        xlabel="k (steps of 1 s)",
        ylabel=f"{component} RMSE in {UNITS[component]}",
        yscale="log",
        ylim=(0.7 * lowest, None),
    )


def prediction(study: str, parameters: dict, component: str, k: np.ndarray) -> np.ndarray:
    """RMSE(k) of x(0) carried on without data: the root of the process noise's variance (31)."""
    axes = len(plugins.study(study).components[component])
    time = k * parameters.sampling_time
    variance = time**3 / 3 if component == "position" else time
    return np.sqrt(axes * parameters.acceleration_variance * variance)


def rmse_figure(results: Results, study: str, component: str) -> Figure:
    """Figures 6, 7, 12, 13: every filter."""
    drawn, axes = style.figure(size=(7.2, 4.6))
    rmse_over_k(axes, results, study, component, all_filters(results, study))
    trials = len(results.log(study, "base").trials)
    axes.set_title(f"{trials} runs; bands ±2 standard errors, dotted the median run", fontsize=9)
    axes.legend(fontsize=8, ncols=2)
    return drawn


def sweep_figure(results: Results, labels: dict[str, str]) -> Figure:
    """Figures 8, 9, 10: PF-ROSS-EH at several points, position and velocity."""
    drawn, grid = style.figure(1, 2, size=(9.2, 4.2))
    for axes, component in zip(grid, UNITS, strict=True):
        rmse_over_k(axes, results, "rss_2d", component, over_points(labels))
    grid[0].legend(fontsize=8)
    trials = len(results.log("rss_2d", "base").trials)
    drawn.suptitle(
        f"PF-ROSS-EH, {trials} runs; bands ±2 standard errors, dotted the median run", fontsize=10
    )
    return drawn


def estimates(results: Results, study: str) -> dict[str, np.ndarray]:
    """Truth and estimates of the shown run, (steps + 1, n): the paper's two and any new filter."""
    truth = results.log(study, "base").values["/truth"][RUN]
    return {"truth": truth} | {
        f: truth + results.runs(study, "base", f).error[RUN]
        for f in results.filters(study, "base")
        if f not in NOT_SHOWN
    }


def sensor_of_run(results: Results) -> dict[str, np.ndarray]:
    """What sensor 4 does in the shown run, each (steps + 1,): y, energy, sent, saturated."""
    log = results.log("rss_2d", "base")
    return {
        "y": log.field("/sensor", f"y_{SENSOR}")[RUN],
        "energy": log.field("/network", f"energy_{SENSOR}")[RUN],
        "sent": log.field("/network", f"sent_{SENSOR}")[RUN] == 1,
        "saturated": signal_strength.saturated(log, SENSOR - 1)[RUN],
    }


def transmission(axes: Axes, results: Results, study: str, point: str, last: int) -> None:
    """Transmission probability over k: Lemma 1, the exact chain, and the share in the logs."""
    log = results.log(study, point)
    parameters, k = log.parameters, np.arange(last + 1)
    queue = harvesting_sensors.queue(parameters)
    for rule, name, look in (
        ("lemma1", "Lemma 1", {"color": style.COLOURS[1], "ls": "--"}),
        ("exact", "exact chain of (E, H)", {"color": style.COLOURS[0]}),
    ):
        axes.plot(
            k,
            energy_harvesting.transmission_probability(queue, last, rule),
            lw=1.4,
            label=name,
            **look,
        )
    sent = harvesting_sensors.sent(log)
    share = sent[:, : last + 1].mean(axis=(0, 2))
    error = np.sqrt(share * (1 - share) / (len(sent) * sent.shape[-1]))
    axes.errorbar(k, share, BAND * error, fmt=".", color="black", ms=4, lw=0.8, label="simulated")
