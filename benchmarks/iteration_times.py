"""Time of an iteration of RBPF and Fast RBPF over the number of particles, for Fig. 2.

    python benchmarks/iteration_times.py

overwrites params/measured/unknown_losses_iteration_times.csv with this machine's times. No rule
does: a rebuild gives the same bytes on any machine.
"""

import os
import platform
import time
from pathlib import Path

import numpy as np
import pandas as pd

from repro.params import load_paper
from repro.run import run
from repro.simulate import simulated
from repro.studies.linear_losses import TRIALS_A_BLOCK

ROOT = Path(__file__).parent.parent
MEASURED = ROOT / "params" / "measured" / "unknown_losses_iteration_times.csv"
STEPS, SECONDS = 100, 1.5  # of repeating, of which the best counts


def processor() -> str:
    """Model of the processor and number of cores."""
    lines = Path("/proc/cpuinfo")
    if not lines.exists():
        return platform.processor()
    name = next(line for line in lines.read_text().splitlines() if line.startswith("model name"))
    return f"{name.split(':')[1].strip()}, {os.cpu_count()} cores"


def main() -> None:
    points = load_paper(ROOT / "params" / "unknown_losses.yaml", ROOT / "workflow" / "schemas")
    rows = []
    for point, (parameters, filters) in points.studies["linear_losses"].items():
        if not point.startswith("particles="):
            continue
        particles = filters["rbpf"]["particles"]
        trials = min(250, max(1, TRIALS_A_BLOCK // particles))
        log = simulated("linear_losses", point, parameters | {"steps": STEPS}, 0, np.arange(trials))
        for name in ("rbpf", "rbpf_fast"):
            times, end = [], time.perf_counter() + SECONDS
            while time.perf_counter() < end:
                start = time.process_time()
                run(log, name, filters[name])
                times.append(time.process_time() - start)
            rows.append(
                {"filter": name, "particles": particles, "loss": parameters["loss_probability"]}
                | {"microseconds": min(times) / trials / STEPS * 1e6}
                | {"machine": f"{processor()}; NumPy {np.__version__}, one core"}
            )
            print(rows[-1])
    MEASURED.parent.mkdir(exist_ok=True)
    pd.DataFrame(rows).to_csv(MEASURED, index=False, float_format="%.4g", lineterminator="\n")


if __name__ == "__main__":
    main()
