"""Figure 2: time and accuracy of the RBPF over its number of particles, linear system."""

import pandas as pd
from matplotlib.figure import Figure

from repro.papers.unknown_losses.drawings import particles_needed
from repro.tables.results import Results

NEEDS = {
    "tables": ["linear_losses"],
    "points": {"linear_losses": ["particles=2-loss=0.3", "particles=2-loss=0.5"]},
    "measured": ["params/measured/unknown_losses_iteration_times.csv"],
}
CAPTION = (
    "Figure 2. Time of an iteration of one trial (best of several, batched over trials), "
    "measured once on the machine named above it by benchmarks/iteration_times.py, which a "
    "rebuild does not repeat; sum of RMSE; and how many distinct triples the fast form "
    "updates. p and the grid of N are assumed. figures/studies/linear_losses has every filter."
)


def draw(results: Results) -> Figure:
    return particles_needed(results, pd.read_csv(NEEDS["measured"][0]))
