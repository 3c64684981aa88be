"""Claims about the special cases of PF-ROSS-EH [energy_harvesting Remark 5]."""

from collections.abc import Callable
from typing import Any

import numpy as np

from repro.papers.energy_harvesting.compared import PROPOSED
from repro.runner import run
from repro.simulate import simulated
from repro.studies.families.harvesting_sensors import HarvestingParameters
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim

CLAIMS: list[Claim] = []


@claim(
    CLAIMS,
    "pf-ross-eh-reduces-to-pf-eh",
    "Remark 5: Without saturation, gbar = 0, PF-ROSS-EH is the filter of empty batteries only.",
)
def reduces_to_energy_only(results: Results) -> list[Part]:
    return equal_estimates(results, "pf_eh", lambda _: {"saturation_probability": 0.0})


@claim(
    CLAIMS,
    "pf-ross-eh-reduces-to-pf-ross",
    "Remark 5: If all is transmitted, lambda = 1, PF-ROSS-EH is the filter of saturation only.",
)
def reduces_to_saturation_only(results: Results) -> list[Part]:
    def one_unit_at_each_step(parameters: HarvestingParameters) -> dict[str, Any]:
        units = np.eye(len(parameters.harvest_transition))
        return {"harvest_transition": np.tile(units[1], (len(units), 1)).tolist()}

    return equal_estimates(results, "pf_ross", one_unit_at_each_step)


def equal_estimates(
    results: Results, other: str, changes: Callable[[HarvestingParameters], dict[str, Any]]
) -> list[Part]:
    """PF-ROSS-EH and the other filter have the same estimates under the changed parameters."""
    parts = []
    for study in ("ungm", "rss_2d"):
        log, analysis = results.log(study, "base"), results.analysis(study)
        parameters = type(log.parameters).checked(
            log.parameters.plain() | changes(log.parameters), study
        )
        trials = log.trials[: analysis.reduction_trials]
        changed = simulated(study, "base", parameters, log.seed, trials)
        settings = analysis.reduction_settings.plain()
        first, second = (run(changed, name, settings)[0] for name in (PROPOSED, other))
        largest = np.abs(first - second).max()
        parts.append(below(f"{study}: largest difference", largest, analysis.rounding))
    return parts
