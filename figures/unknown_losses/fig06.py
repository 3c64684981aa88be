"""Figure 6: the structure of the quadrotor, drawn."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.diagrams import quadrotor
from repro.tables.results import Results

NEEDS = {}
CAPTION = (
    'Figure 6. The quadrotor in "+" configuration: frames, states and rotors as the equations of '
    "repro.models.quadrotor have them. A drawing; it depends on no result."
)


def draw(results: Results) -> Figure:
    return quadrotor()
