"""Figure 6: the structure of the quadrotor, drawn."""

from repro.papers.unknown_losses.diagrams import quadrotor

NEEDS = {}
CAPTION = (
    'Figure 6. The quadrotor in "+" configuration: frames, states and rotors as the equations of '
    "repro.models.quadrotor have them. A drawing; it depends on no result."
)


def draw(results):
    return quadrotor()
