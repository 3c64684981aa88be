"""Table II: the parameters of the tracking example, from the log that was simulated with them."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.symbols import SYMBOLS
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = (
    "Table II. Parameters of the tracking example, as attached to the log of our runs; and the "
    "number of runs here and in the paper."
)
NAMES = (
    "sampling_time",
    "sensors",
    "reference_distance",
    "path_loss_exponent",
    "saturation_probability",
    "initial_energy",
    "energy_capacity",
    "harvest_transition",
    "reference_power",
    "saturation_level",
    "measurement_variances",
    "channel_variance",
    "acceleration_variance",
    "trials",
)


def numbers(value: float | Sequence[float]) -> str:
    """A number, or several, as a cell shows them."""
    values = value if isinstance(value, Sequence) else (value,)
    return ", ".join(f"{entry:g}" for entry in values)


def draw(results: Results) -> Figure:
    parameters = results.parameters("rss_2d", "base")
    values = parameters.plain() | {
        "harvest_transition": len(parameters.harvest_transition) - 1,
        "measurement_variances": parameters.measurement_variances[: parameters.sensors],
    }
    symbols = {name: SYMBOLS[name].text for name in NAMES} | {"harvest_transition": r"$\bar{H}$"}
    rows = [(symbols[name], name, numbers(values[name]), SYMBOLS[name].unit) for name in NAMES]
    printed = results.analysis("rss_2d").printed_trials
    rows.append((symbols["trials"], "trials in the paper", numbers(printed), ""))
    return style.table(rows, ("symbol", "parameter", "value", "unit"), (0.16, 0.36, 0.34, 0.14))
