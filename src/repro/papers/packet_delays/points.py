"""The points of the paper's two studies, as its tables and figures arrange them."""

import numpy as np

from repro.logs import Log
from repro.tables.results import Results

LINEAR, TRACKING = "linear_delays", "wsn_tracking"
CONSTANT_DELAY = "constant-delay"  # of LINEAR: p = 0
# Filters of the redrawn figures: the paper's and those that it compares, and as yardsticks a genie
# and the best filter of the OMVF's form (Figs. 1-2), and the EKF that knows the arrivals (3-10).
FIGURES_1_2 = ("omvf", "nahi", "intermittent_kf", "sun", "genie", "best_in_form")
FIGURES_3_6 = ("emvf", "ekf", "iekf")
FIGURES_7_10 = ("emvf", "iekf")


def tracking_point(bound: int, arrival: str) -> str:
    """Name of the tracking point with N = `bound` and p = `arrival`."""
    return f"n{bound}-arrival={arrival}"


def linear_points(results: Results) -> dict[float, str]:
    """Points of Figs. 1-2 by their arrival probability."""
    before = "arrival="
    return {
        float(point.removeprefix(before)): point
        for point in results.catalogue[LINEAR]
        if point.startswith(before)
    }


def table_2(results: Results) -> dict[int, list[str]]:
    """Arrival probabilities of Table 2, rising, by N.

    They are those that run with N = 0 too; Figs. 3-6 add two for N = 1 and N = 2.
    """
    by_bound: dict[int, list[str]] = {}
    for point in results.catalogue[TRACKING]:
        bound, separator, arrival = point.partition("-arrival=")
        if separator and bound[1:].isdigit():
            by_bound.setdefault(int(bound[1:]), []).append(arrival)
    arrivals = sorted(by_bound[0], key=float)
    return {bound: arrivals for bound in sorted(by_bound)}


def missed_packets(log: Log) -> np.ndarray:
    """Whether the packet of k = 1, 2, ... is late or lost, (trials, steps)."""
    return log.field("/network", "delay")[:, 1:] != 0
