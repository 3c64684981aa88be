"""Table I: the symbols of the tracking examples, with the names and values that they have here."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.symbols import SYMBOLS
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"points": {"rss_2d": ["base"]}}
CAPTION = "Table I. The paper's symbols, their names here, and the values of the base point."
PARTICLES = ("$M$", "number of particles", "setting particles of a filter", "")
LONGEST = 24  # characters of a value that fit into a cell
TOPICS = (
    (r"$s_x^t, s_y^t$", "true position, m", "/truth: s_x, s_y"),
    (r"$v_x^t, v_y^t$", "true velocity, m/s", "/truth: v_x, v_y"),
    (r"$s^{t,j}, v^{t,j}$", "the same in run j", "trial j of /truth"),
    (r"$\hat{s}^{t,j}, \hat{v}^{t,j}$", "their estimates in run j", "/truth + error of a run"),
)


def draw(results: Results) -> Figure:
    parameters = results.parameters("rss_2d", "base")
    rows = [(symbol, meaning, place, "") for symbol, meaning, place in TOPICS]
    for name, symbol in SYMBOLS.items():
        value = str(parameters.plain()[name])
        shortened = value[:LONGEST] + "..." * (len(value) > LONGEST)
        unit = f", {symbol.unit}" if symbol.unit else ""
        rows.append((symbol.text, symbol.meaning + unit, name, shortened))
    rows.append(PARTICLES)
    return style.table(rows, ("symbol", "meaning", "here", "value"), (0.14, 0.34, 0.27, 0.25))
