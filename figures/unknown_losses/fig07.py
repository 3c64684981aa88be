"""Figure 7: the control architecture, drawn."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.diagrams import control_loop
from repro.tables.results import Results

NEEDS = {}
CAPTION = (
    "Figure 7. The loop: the two controllers see nothing but the estimate. A drawing of what "
    "repro.control.flight does; it depends on no result."
)


def draw(results: Results) -> Figure:
    return control_loop()
