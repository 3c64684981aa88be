"""Time of an iteration of RBPF and Fast RBPF over the number of particles, for Fig. 2.

    python benchmarks/iteration_times.py

overwrites params/measured/unknown_losses_iteration_times.csv with this machine's times. No rule
does: a rebuild gives the same bytes on any machine.
"""

import time
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from side_by_side import processor

from repro.logs import Log
from repro.papers.unknown_losses.claims.particles import TIMES
from repro.parameters.load import load_paper
from repro.runner import run
from repro.simulate import simulated
from repro.studies import linear_losses

ROOT = Path(__file__).parent.parent
MEASURED = ROOT / TIMES
STEPS, ROUNDS = 100, 6
SECONDS = 0.4  # for which a round repeats; its best time counts


def best_time(log: Log, name: str, settings: dict[str, Any]) -> float:
    """Best CPU time in s of the runs of one round."""
    times, end = [], time.perf_counter() + SECONDS
    while time.perf_counter() < end:
        start = time.process_time()
        run(log, name, settings)
        times.append(time.process_time() - start)
    return min(times)


def main() -> None:
    paper = load_paper(ROOT / "params" / "unknown_losses.yaml")
    rows = []
    for point, (parameters, filters, *_) in paper.studies["linear_losses"].items():
        if not point.startswith("particles="):
            continue
        assert isinstance(parameters, linear_losses.Parameters)
        particles = filters["rbpf"]["particles"]
        block = linear_losses.STUDY.systems_per_block // particles
        trials = min(parameters.trials, max(1, block))
        short = parameters.model_copy(update={"steps": STEPS})
        log = simulated("linear_losses", point, short, 0, np.arange(trials))
        bests = {"rbpf": [], "rbpf_fast": []}
        for name in bests:
            run(log, name, filters[name])  # compiled, or loaded, before a clock runs
        for _ in range(ROUNDS):  # in turn, so that whatever else the machine does disturbs both
            for name, best in bests.items():
                best.append(best_time(log, name, filters[name]) / trials / STEPS * 1e6)
        for name, best in bests.items():
            rows.append(
                {"filter": name, "particles": particles, "loss": parameters.loss_probability}
                | {"microseconds": np.median(best), "error": np.std(best, ddof=1) / ROUNDS**0.5}
                | {"machine": f"{processor()}; NumPy {np.__version__}, one core"}
            )
            print(*list(rows[-1].values())[:-1])
    MEASURED.parent.mkdir(exist_ok=True)
    pd.DataFrame(rows).to_csv(MEASURED, index=False, float_format="%.4g", lineterminator="\n")


if __name__ == "__main__":
    main()
