"""The filters and points that the paper's figures compare, found in the catalogue of the run."""

import re

from repro.parameters.point_names import is_reading
from repro.tables.results import Catalogue

PROPOSED = ("bkf_1", "bkf_2", "rbpf")
# The filters in the published figures of each study.
PICTURED = {
    "linear_losses": ("ekf", "iekf", *PROPOSED),  # Fig. 1
    "radar": ("iekf", *PROPOSED),  # Figs. 3-5
    "quadrotor": ("ekf_no_loss", "iekf", "bkf_1", "bkf_2", "rbpf_fast"),  # Figs. 8, 9
}
SWEEP = "loss="
PARTICLES = re.compile(r"particles=(\d+)-loss=([\d.]+)")


def swept(catalogue: Catalogue, study: str, prefix: str = SWEEP) -> dict[float, str]:
    """Loss probability -> point, of the points that are named `prefix` and the probability."""
    return {
        float(point.removeprefix(prefix)): point
        for point in catalogue[study]
        if point.startswith(prefix)
    }


def most_runs(catalogue: Catalogue, study: str) -> dict[float, str]:
    """The point with most runs of each loss probability: the pooled one where there is one."""
    return swept(catalogue, study) | swept(catalogue, study, f"pooled-{SWEEP}")


def particle_sweeps(
    catalogue: Catalogue, study: str = "linear_losses"
) -> dict[float, dict[int, str]]:
    """Loss probability -> number of particles -> point, of Fig. 2, or of the same on the radar."""
    sweeps: dict[float, dict[int, str]] = {}
    for point in catalogue[study]:
        if named := PARTICLES.fullmatch(point):
            sweeps.setdefault(float(named[2]), {})[int(named[1])] = point
    return sweeps


def plain_points(catalogue: Catalogue, study: str) -> list[str]:
    """The points of a study that are no readings of others."""
    return [point for point in catalogue[study] if not is_reading(point)]


def rbpf_of(catalogue: Catalogue, study: str, point: str) -> str:
    """The RBPF of a point: by Algorithm 4 where Algorithm 3, of the same results, does not run."""
    return "rbpf" if "rbpf" in catalogue[study][point] else "rbpf_fast"


def proposed_filters(catalogue: Catalogue, study: str, point: str) -> tuple[str, ...]:
    """The three filters that the paper proposes, as they run on a point."""
    return ("bkf_1", "bkf_2", rbpf_of(catalogue, study, point))
