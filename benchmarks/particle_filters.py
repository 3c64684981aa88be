"""CPU time of the particle filters beside the library `particles` and JAX.

    python benchmarks/particle_filters.py [--short]

The peers need the `bench` extra and benchmarks/requirements-particles.txt, which says why; one that
is not installed is left out. All run the bootstrap filter of PF-ROSS-EH, [energy_harvesting
Algorithm 1] with the likelihood (27), on the same measurements. --short takes fewer trials.
"""

import _as_in_jobs  # noqa: F401  # isort: skip

import importlib
import sys

from side_by_side import Contender, compared, introduce, of_peer, of_project, problem, sizes

STUDIES = {  # trials of the project's filter, of JAX, of `particles`; goal in ns
    "ungm": (1000, 1000, 200, 8.0),
    "rss_2d": (200, 200, 60, 22.0),
}
PEERS = {  # module, and its further arguments
    "JAX": ("peers.jax_bootstrap", ()),
    "JAX, normals in float32": ("peers.jax_bootstrap", ("float32",)),
    "particles": ("peers.particles_library", ()),
}
AUXILIARY = {"mapf": 50.0, "mpf": 30.0}  # goals, ns


def bootstrap(study: str, repetitions: int, shorter: int) -> bool:
    """PF-ROSS-EH, and the same filter of the peers."""
    trials, of_jax, of_particles, goal = (
        max(2, n // shorter) if isinstance(n, int) else n for n in STUDIES[study]
    )
    given = problem("energy_harvesting", study, "base", trials)
    count = given.settings["pf_ross_eh"]["particles"]
    filters = [Contender("PF-ROSS-EH", of_project(given, "pf_ross_eh"), trials, count, goal)]
    for name, (module, arguments) in PEERS.items():
        try:
            peer = importlib.import_module(module)
        except ImportError as error:
            print(f"{name} is left out: {error}")
            continue
        few = of_particles if name == "particles" else of_jax
        run = of_peer(peer.bootstrap(given.log, count, few, *arguments))
        filters.append(Contender(name, run, few, count, is_peer=True))
    title = f"{study}, {count} particles"
    return compared(title, "particle-step", given.log, filters, repetitions)


def auxiliary(repetitions: int, trials: int = 24) -> bool:
    """The particle filters of a network of coupled targets, of which no library has the like."""
    given = problem("censored_network", "deadband", "base", trials)
    nodes = len(given.log.parameters.speed)
    filters = [
        Contender(
            name.upper(),
            of_project(given, name),
            trials,
            given.settings[name]["particles"] * nodes,
            goal,
        )
        for name, goal in AUXILIARY.items()
    ]
    unit = "particle, node and step"
    return compared(f"deadband, {nodes} nodes", unit, given.log, filters, repetitions)


def main(repetitions: int, shorter: int) -> bool:
    """All tables; whether every goal is reached."""
    reached = [bootstrap(study, repetitions, shorter) for study in STUDIES]
    return all([*reached, auxiliary(repetitions, max(2, 24 // shorter))])


if __name__ == "__main__":
    introduce()
    sys.exit(0 if main(*sizes()) else 1)
