"""Figure 2: error of x2 over the packet arrival probability."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.error_over_arrival import error_over_arrival_probability
from repro.tables.results import Results

NEEDS = {
    "tables": ["linear_delays"],
    "points": {
        "linear_delays": [
            "arrival=0.1",
            "arrival=0.2",
            "arrival=0.3",
            "arrival=0.4",
            "arrival=0.5",
            "arrival=0.6",
            "arrival=0.7",
            "arrival=0.8",
            "arrival=0.9",
            "arrival=1.0",
        ]
    },
}
CAPTION = (
    "Redrawing of Fig. 2: RMS error of x2 over the packet arrival probability, with the error "
    "that the OMVF claims. The paper prints no number. The filter of Sun (2009) and the best "
    "filter of the OMVF's form (6) are exact. The claim that the OMVF is better than that of Sun "
    "fails below: it is above on the same runs. Every filter: figures/studies/linear_delays."
)


def draw(results: Results) -> Figure:
    return error_over_arrival_probability(results, "x2")
