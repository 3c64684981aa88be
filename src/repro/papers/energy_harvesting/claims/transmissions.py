"""How often a sensor transmits: by Lemma 1, by the exact chain, and in the logs."""

import numpy as np

from repro.network import energy_harvesting
from repro.network.energy_harvesting import TransmissionRule
from repro.studies.families import harvesting_sensors
from repro.tables.results import Results


def probability(results: Results, study: str, point: str, rule: TransmissionRule) -> np.ndarray:
    """lambda(k) for k = 1 ... K."""
    parameters = results.parameters(study, point)
    queue = harvesting_sensors.queue(parameters)
    return energy_harvesting.transmission_probability(queue, parameters.steps, rule)[1:]


def share_sent(results: Results, study: str, point: str) -> np.ndarray:
    """Share of the sensors that transmit at k = 1 ... K, (trials, K)."""
    return results.each_log(
        study, point, lambda log: harvesting_sensors.sent(log)[:, 1:].mean(axis=2)
    )
