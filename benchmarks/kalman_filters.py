"""CPU time of the filters for unknown losses, and of EKF beside FilterPy and NumPy.

    python benchmarks/kalman_filters.py [--short]

FilterPy, an object a trial, needs the `bench` extra and is left out without it. The peers solve
EKF's problem: every received value is a measurement. --short takes fewer trials.
"""

import _as_in_jobs  # noqa: F401  # isort: skip

import importlib
import sys

from side_by_side import Contender, compared, introduce, of_peer, of_project, problem, sizes

STUDIES = {  # states, goals of a Kalman update and of a particle in ns, trials of the RBPF
    "linear_losses": (2, 80.0, 20.0, 500),
    "radar": (6, 160.0, 60.0, 80),
}
TRIALS, OF_FILTERPY = 6000, 20
UPDATES = ("ekf", "iekf", "bkf_1", "bkf_2")
PEERS = {"NumPy, batched": ("peers.numpy_kalman", TRIALS)}
PEERS |= {"FilterPy": ("peers.filterpy_filters", OF_FILTERPY)}


def updates(study: str, repetitions: int, shorter: int) -> bool:
    """Filters with one Kalman update a step, and EKF of the peers."""
    n, goal, *_ = STUDIES[study]
    trials = TRIALS // shorter
    given = problem("unknown_losses", study, "loss=0.5", trials)
    filters = [
        Contender(name.upper().replace("_", "-"), of_project(given, name), trials, goal=goal)
        for name in UPDATES
    ]
    for name, (module, most) in PEERS.items():
        try:
            peer = importlib.import_module(module)
        except ImportError as error:
            print(f"{name} is left out: {error}")
            continue
        few = max(2, most // shorter)
        filters.append(Contender(name, of_peer(peer.filtered(given.log, few)), few, is_peer=True))
    return compared(f"{study}, n = {n}", "trial-step", given.log, filters, repetitions)


def rao_blackwell(study: str, repetitions: int, shorter: int) -> bool:
    """RBPF and its fast form, of which no library has the like."""
    n, _, goal, most = STUDIES[study]
    trials = max(2, most // shorter)
    given = problem("unknown_losses", study, "loss=0.5", trials)
    count = given.settings["rbpf"]["particles"]
    filters = [
        Contender("RBPF", of_project(given, "rbpf"), trials, count, goal),
        Contender("Fast RBPF", of_project(given, "rbpf_fast"), trials, count),
    ]
    title = f"{study}, n = {n}, {count} particles"
    return compared(title, "particle-step", given.log, filters, repetitions)


def main(repetitions: int, shorter: int) -> bool:
    """All tables; whether every goal is reached."""
    tables = [f(study, repetitions, shorter) for study in STUDIES for f in (updates, rao_blackwell)]
    return all(tables)


if __name__ == "__main__":
    introduce()
    sys.exit(0 if main(*sizes()) else 1)
