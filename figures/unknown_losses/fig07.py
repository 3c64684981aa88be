"""Figure 7: the control architecture, drawn."""

from repro.papers.unknown_losses.diagrams import control_loop

NEEDS = {}
CAPTION = (
    "Figure 7. The loop: the estimate is all that the two controllers get. A drawing of what "
    "repro.control.flight does; it depends on no result."
)


def draw(results):
    return control_loop()
