"""How many published values and claims reproduce, by paper and class of evidence."""

from matplotlib.figure import Figure

from repro.plot.tally import tally
from repro.tables.results import Results

NEEDS = {"diff": True}
CAPTION = (
    "Published values and claims of each paper by verdict and by class of evidence: identity, an "
    "exact equality or count; fitted, a parameter was chosen on these numbers; predicted, a test "
    "that could have failed; conditional, it could, but rests on an assumed layout or horizon."
)


def draw(results: Results) -> Figure:
    return tally(results)
