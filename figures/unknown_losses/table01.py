"""Table I: operations of one iteration, counted in the algorithms as printed."""

from matplotlib.figure import Figure

from repro.plot import style
from repro.tables.results import Results

NEEDS = {"tables": ["complexity"]}
CAPTION = (
    "Table I. Gaussian densities and matrix products of one iteration, and how its cost grows: the "
    "paper's, and as counted in the algorithms written out as printed. Products of two matrices "
    "count, Sigma C' of the gain once, products with a vector not; the order is that of the "
    "multiplications in them from 100 to 200 states. The RBPF needs one density a particle, that "
    "of the branch it drew."
)
PAPERS = {
    "iekf": ("IEKF", "0", "7", "O(n³)"),
    "rbpf": ("RBPF", "2N", "O(N)", "O(Nn³)"),
    "bkf_1": ("BKF-I", "2", "7", "O(n³)"),
    "bkf_2": ("BKF-II", "2", "9", "O(n³)"),
}

WIDTHS = (0.1, 0.145, 0.175, 0.145, 0.175, 0.12, 0.14)
KINDS = ("densities", "products", "cost")


def draw(results: Results) -> Figure:
    table = results.table("complexity")
    counted = table.set_index(["filter", "component"])["value"].to_dict()
    particles = int(table["point"].iloc[0].split("=")[1])

    def ours(filter_: str, component: str) -> str:
        count = float(counted[filter_, component])
        if filter_ != "rbpf":
            return f"{count:g}"
        return "N" if count == particles else f"{count / particles:g}N"

    def order(filter_: str) -> str:
        times_n = "N" if filter_ == "rbpf" else ""
        return f"{times_n}n^{float(counted[filter_, 'order_in_n']):.2f}"

    cells = []
    for filter_, (name, densities, products, cost) in PAPERS.items():
        row = [name, densities, ours(filter_, "densities"), products, ours(filter_, "products")]
        cells.append([*row, cost, order(filter_)])
    heads = ("filter", *(f"{what}, {whose}" for what in KINDS for whose in ("paper", "counted")))
    # The paper gives an order where it has a capital O, which is compared elsewhere.
    differing = [
        (place, column + 1)
        for place, row in enumerate(cells)
        for column in (1, 3)
        if row[column] != row[column + 1] and not row[column].startswith("O")
    ]
    return style.table(cells, heads, WIDTHS, differing)
