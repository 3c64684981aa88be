"""What the figures of [energy_harvesting] share: one run, and RMSE over k with its band."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.network import energy_harvesting
from repro.network.energy_harvesting import TransmissionRule
from repro.papers.energy_harvesting.compared import (
    PAPERS_FILTERS,
    PROPOSED,
    SWEPT_STUDY,
    Sweep,
    study_of,
)
from repro.papers.energy_harvesting.symbols import SYMBOLS
from repro.plot import looks, style
from repro.plot.style import BAND
from repro.studies.families import harvesting_sensors, signal_strength
from repro.studies.families.signal_strength import SignalStrengthParameters
from repro.tables.results import Results

UNITS = {"position": "m", "velocity": "m/s"}
EXPLAINED = f"bands ±{BAND:g} standard errors, dotted the median run"
OWN_LINES = ("--", "-.")


class Curve(NamedTuple):
    """RMSE over k of a filter on a point."""

    label: str
    point: str
    filter: str
    colour: str
    line: str = "-"


def compared_filters(results: Results, study: str) -> list[Curve]:
    """The filters that the paper compares, and a reader's own, on the study's base point."""
    return [
        Curve(style.label(f), "base", f, style.look(results, f)["color"])
        for f in results.and_own(study, "base", PAPERS_FILTERS)
    ]


def over_points(results: Results, labels: dict[str, str]) -> list[Curve]:
    """PF-ROSS-EH at several points, given with their labels; dashed a reader's own filters."""
    colour = style.look(results, PROPOSED)["color"]
    colours = dict(zip(labels, looks.shades(colour, len(labels)), strict=True))
    own = [
        Curve(f"{style.label(f)}, {label}", point, f, colours[point], OWN_LINES[i % len(OWN_LINES)])
        for i, f in enumerate(results.own_filters)
        for point, label in labels.items()
        if f in results.filters(SWEPT_STUDY, point)
    ]
    proposed = [Curve(label, point, PROPOSED, colours[point]) for point, label in labels.items()]
    return [*proposed, *own]


def step_label(parameters: SignalStrengthParameters) -> str:
    """Label of an axis over k."""
    return f"k (steps of {parameters.sampling_time:g} s)"


def rmse_over_k(
    axes: Axes, results: Results, study: str, component: str, curves: list[Curve]
) -> None:
    """RMSE(k) with its Monte Carlo band, the median error of a run, and open-loop prediction."""
    table = results.curves(study)
    table = table.loc[(table["component"] == component) & (table["k"] > 0)]
    lowest = np.inf
    for curve in curves:
        rows = table.loc[(table["point"] == curve.point) & (table["filter"] == curve.filter)]
        lowest = min(lowest, rows["median"].min())
        axes.plot(
            rows["k"],
            rows["value"],
            lw=1.4,
            ls=curve.line,
            label=curve.label,
            color=curve.colour,
        )
        axes.plot(rows["k"], rows["median"], lw=0.9, ls=":", color=curve.colour)
        style.band(axes, rows["k"], rows["value"], rows["mcse"], curve.colour)
    parameters = results.parameters(study, "base")
    k = np.arange(1, parameters.steps + 1)
    axes.plot(k, prediction(study, parameters, component, k), color="0.55", lw=1.2, label="no data")
    axes.set(
        xlabel=step_label(parameters),
        ylabel=f"{component} RMSE in {UNITS[component]}",
    )
    style.plain_log(axes)
    axes.set_ylim(bottom=0.7 * lowest)


def prediction(
    study: str, parameters: SignalStrengthParameters, component: str, k: np.ndarray
) -> np.ndarray:
    """RMSE(k) of x(0) predicted without data, from the variance of the process noise (31)."""
    of_study = study_of(study)
    assert isinstance(of_study, harvesting_sensors.HarvestingStudy)
    axes = len(of_study.components[component])
    time = k * parameters.sampling_time
    variance = time**3 / 3 if component == "position" else time
    return np.sqrt(axes * parameters.acceleration_variance * variance)


def rmse_figure(results: Results, study: str, component: str) -> Figure:
    """Figures 6, 7, 12, 13: the filters that the paper compares."""
    drawn, axes = style.figure(size=(style.WIDTH, 4.8))
    rmse_over_k(axes, results, study, component, compared_filters(results, study))
    trials = len(results.log(study, "base").trials)
    axes.set_title(f"{trials} runs; {EXPLAINED}", fontsize=9)
    axes.legend(fontsize=8, ncols=2)
    return drawn


def sweep_figure(results: Results, sweep: Sweep) -> Figure:
    """Figures 8, 9, 10: PF-ROSS-EH at several points, position and velocity."""
    symbol = SYMBOLS[sweep.parameter].text
    labels = {
        point: rf"$\{value}$" if sweep.matrices else f"{symbol} = {value}"
        for point, value in sweep.values(results).items()
    }
    table, trials = results.table(SWEPT_STUDY), len(results.log(SWEPT_STUDY, "base").trials)
    lost = table.loc[table["filter"] == PROPOSED].groupby("point")["lost"].first()
    for point in labels:
        labels[point] += f": {lost[point] * trials:.0f} runs lost"
    drawn, grid = style.figure(1, 2, size=(style.WIDTH, 4.0))
    for axes, component in zip(grid, UNITS, strict=True):
        rmse_over_k(axes, results, SWEPT_STUDY, component, over_points(results, labels))
    grid[0].legend(fontsize=8)
    drawn.suptitle(f"{style.label(PROPOSED)}, {trials} runs; {EXPLAINED}", fontsize=10)
    return drawn


def estimates(
    results: Results, study: str, run: int, shown: Sequence[str] = (PROPOSED,)
) -> dict[str, np.ndarray]:
    """Truth and estimates of a run, (steps + 1, n) each: of `shown` and a reader's own."""
    truth = results.log(study, "base").values["/truth"][run]
    return {"truth": truth} | {
        f: truth + results.runs(study, "base", f).error[run]
        for f in results.and_own(study, "base", shown)
    }


class ShownSensor(NamedTuple):
    """What the shown sensor does in the shown run, each (steps + 1,)."""

    number: int
    output: np.ndarray  # y, dBm
    energy: np.ndarray
    sent: np.ndarray
    saturated: np.ndarray


def shown_sensor(results: Results, run: int) -> ShownSensor:
    """The sensor of Figures 4 and 5 in a run."""
    log, number = results.log("rss_2d", "base"), results.analysis("rss_2d").shown_sensor
    return ShownSensor(
        number,
        output=log.field("/sensor", f"y_{number}")[run],
        energy=log.field("/network", f"energy_{number}")[run],
        sent=log.field("/network", f"sent_{number}")[run] == 1,
        saturated=signal_strength.saturated(log, number)[run],
    )


RULES: dict[TransmissionRule, tuple[str, dict[str, Any]]] = {
    "lemma1": ("Lemma 1", {"color": style.COLOURS[1], "ls": "--"}),
    "exact": ("exact chain of (E, H)", {"color": style.COLOURS[0]}),
}


def transmission(axes: Axes, results: Results, study: str, point: str, last: int) -> None:
    """Transmission probability over k: Lemma 1, the exact chain, and the share in the logs."""
    log = results.log(study, point)
    queue, k = harvesting_sensors.queue(log.parameters), np.arange(last + 1)
    for rule, (name, look) in RULES.items():
        probability = energy_harvesting.transmission_probability(queue, last, rule)
        axes.plot(k, probability, lw=1.4, label=name, **look)
    sent = harvesting_sensors.sent(log)
    share = sent[:, : last + 1].mean(axis=(0, 2))
    error = np.sqrt(share * (1 - share) / (len(sent) * sent.shape[-1]))
    axes.errorbar(k, share, BAND * error, fmt=".", color="black", ms=4, lw=0.8, label="simulated")
