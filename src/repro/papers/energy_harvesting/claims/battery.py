"""Claims about batteries, transmissions, saturated outputs [energy_harvesting Figs. 4, 5, 10]."""

import numpy as np

from repro.logs import Log
from repro.papers.energy_harvesting.claims.transmissions import probability, share_sent
from repro.papers.energy_harvesting.compared import HARVESTS, SWEPT_STUDY
from repro.papers.energy_harvesting.shown import shown_run
from repro.studies.families import harvesting_sensors, signal_strength
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, most, smaller

CLAIMS: list[Claim] = []


@claim(
    CLAIMS,
    "fewer-transmissions-under-pi-2",
    "Sec. IV-B: Under Pi_2 a sensor transmits less often than under Pi_1, at every k.",
)
def harvest_is_the_cause(results: Results) -> list[Part]:
    first, second = (probability(results, SWEPT_STUDY, point, "exact") for point in HARVESTS.points)
    shares = [share_sent(results, SWEPT_STUDY, p).mean(axis=1) for p in HARVESTS.points]
    return [
        below("least favourable k: exact probability under Pi_2 - Pi_1", (second - first).max(), 0),
        smaller("share of transmissions in the logs: Pi_2 - Pi_1", shares[1], shares[0]),
    ]


@claim(
    CLAIMS,
    "sensor-saturates-in-shown-run",
    "Fig. 4: In the shown run the output of the shown sensor is saturated at times.",
)
def saturation_is_seen(results: Results) -> list[Part]:
    sensor, run = results.analysis("rss_2d").shown_sensor, shown_run(results, "rss_2d").trial

    def instants(log: Log) -> np.ndarray:
        return signal_strength.saturated(log, sensor)[:, 1:].sum(axis=1)

    counts = results.each_log("rss_2d", "base", instants)
    return [
        below(f"minus the number of such instants in run {run}", -float(counts[run]), -0.5),
        most("a run has such an instant", counts > 0),
    ]


@claim(
    CLAIMS,
    "battery-obeys-its-equation",
    "Fig. 5: The energy starts at E(0), stays between 0 and the capacity and obeys (6), and a "
    "sensor transmits exactly when it has energy.",
)
def battery_obeys(results: Results) -> list[Part]:
    wrong = results.each_log("rss_2d", "base", broken_rules).sum()
    return [below("entries of all logs that break a rule", wrong, 0.5)]


def broken_rules(log: Log) -> np.ndarray:
    """Number of entries of each run that break a rule of the battery, (trials,)."""
    queue = harvesting_sensors.queue(log.parameters)
    wrong = np.zeros(len(log.trials))
    for i in range(1, log.parameters.sensors + 1):
        energy, harvest, transmits = (
            log.field("/network", f"{name}_{i}") for name in ("energy", "harvest", "sent")
        )
        outside = (energy < 0) | (energy > queue.capacity)
        wrong += (energy[:, 0] != queue.initial_energy) + outside.sum(axis=1)
        wrong += ((energy > 0) != (transmits == 1)).sum(axis=1)
        spent = energy[:, :-1] - transmits[:, :-1]
        kept = np.minimum(spent + harvest[:, 1:], queue.capacity)
        wrong += (energy[:, 1:] != kept).sum(axis=1)
    return wrong
