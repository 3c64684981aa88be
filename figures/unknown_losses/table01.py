"""Table I: operations of one iteration, counted in the algorithms as printed."""

from matplotlib.figure import Figure

from repro.plot import style
from repro.tables.results import Results

NEEDS = {"tables": ["complexity"]}
CAPTION = (
    "Table I. Gaussian densities and matrix products of one iteration: the paper's, and as "
    "counted in the algorithms written out as printed. The RBPF needs one density a particle,"
    " that of the branch it drew; with the density of noise, common to all, N + 1 at most."
)
PAPERS = {
    "iekf": ("IEKF", "0", "7"),
    "rbpf": ("RBPF", "2N", "O(N)"),
    "bkf_1": ("BKF-I", "2", "7"),
    "bkf_2": ("BKF-II", "2", "9"),
}


def draw(results: Results) -> Figure:
    table = results.table("complexity")
    counted = table.set_index(["filter", "component"])["value"].to_dict()
    particles = int(table["point"].iloc[0].split("=")[1])

    def ours(filter_: str, component: str) -> str:
        count = float(counted[filter_, component])
        if filter_ != "rbpf":
            return f"{count:g}"
        return "N" if count == particles else f"{count / particles:g}N"

    cells = [
        [name, densities, ours(filter_, "densities"), products, ours(filter_, "products")]
        for filter_, (name, densities, products) in PAPERS.items()
    ]
    heads = ["filter", "densities,\npaper", "densities,\ncounted", "products,\npaper"]
    drawn, axes = style.figure(size=(6.2, 2.2))
    axes.axis("off")
    drawn_table = axes.table(
        cells, colLabels=[*heads, "products,\ncounted"], loc="center", cellLoc="center"
    )
    drawn_table.scale(1, 1.5)
    for column in range(5):
        drawn_table[0, column].set_height(0.24)
    return drawn
