"""CPU time of the filters for unknown losses: python benchmarks/kalman_filters.py

Limits, with the runner's work: a Kalman update 250 ns a trial-step (n = 2, m = 1; n = 6, m = 2 in
larger batches); the RBPF 60 and 180 ns a particle-step, on a loaded machine. FilterPy, an object a
trial, is timed beside the plain update.
"""

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from filterpy.kalman import ExtendedKalmanFilter, KalmanFilter

from repro import plugins
from repro.logs import Log
from repro.models import Model
from repro.models.sparse import dense
from repro.parameters.load import load_paper
from repro.runner import run
from repro.simulate import simulated

ROOT = Path(__file__).parent.parent
SECONDS = 3.0  # for which a filter is run again and again; its best time counts
LIMITS = {("linear_losses", False): 250, ("radar", False): 250}
LIMITS |= {("linear_losses", True): 60, ("radar", True): 180}  # ns


def cpu(function: Callable[[], object]) -> float:
    """Best CPU time in s."""
    times, end = [], time.perf_counter() + SECONDS
    while time.perf_counter() < end:
        start = time.process_time()
        function()
        times.append(time.process_time() - start)
    return min(times)


def filterpy_steps(log: Log, model: Model) -> None:
    """Predict and update of the first trial at every step, as if no packet were lost."""
    n, m = len(model.initial_mean), len(model.measurement_covariance)
    linear = log.study == "linear_losses"
    filter_: Any = (KalmanFilter if linear else ExtendedKalmanFilter)(dim_x=n, dim_z=m)
    filter_.x, filter_.P = model.initial_mean[:, None].copy(), model.initial_covariance.copy()
    filter_.F = dense(model.transition_jacobian(model.initial_mean, 0), (), n)
    filter_.Q, filter_.R = model.process_covariance, model.measurement_covariance

    def jacobian(x):
        return dense(model.measurement_jacobian(x[:, 0], None), (), n)

    if linear:
        filter_.H = jacobian(filter_.x)
    for received in log.values["/received"][0]:
        filter_.predict()
        if linear:
            filter_.update(received[:, None])
        else:
            filter_.update(
                received[:, None],
                jacobian,
                lambda x: model.measurement(x[:, 0], None)[:, None],
                residual=lambda y, h: model.innovation(y[:, 0], h[:, 0])[:, None],
            )


def main() -> None:
    paper = load_paper(ROOT / "params" / "unknown_losses.yaml")
    for study in ("linear_losses", "radar"):
        parameters, filters, *_ = paper.studies[study]["loss=0.5"]
        trials = parameters.trials
        log = simulated(study, "loss=0.5", parameters, 0, np.arange(trials))
        steps = log.values["/truth"].shape[1]
        for name in ("ekf", "iekf", "bkf_1", "bkf_2", "rbpf", "rbpf_fast"):
            particles = filters.get(name, {}).get("particles", 1)
            first = trials if particles < 100 else 80
            few = log._replace(
                trials=log.trials[:first],
                values={topic: values[:first] for topic, values in log.values.items()},
            )
            settings = filters.get(name, {})
            seconds = cpu(partial(run, few, name, settings))
            spent = seconds / len(few.trials) / steps / particles * 1e9
            limit = LIMITS[study, particles > 1]
            unit = "particle-step" if particles > 1 else "trial-step"
            print(f"{study:14} {name:10} {spent:8.0f} ns a {unit} (limit {limit})")
        model = plugins.study(study).model(parameters)
        spent = cpu(partial(filterpy_steps, log, model)) / steps * 1e9
        print(f"{study:14} FilterPy   {spent:8.0f} ns a trial-step")


if __name__ == "__main__":
    main()
