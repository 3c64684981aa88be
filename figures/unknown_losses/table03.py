"""Table III: parameters of the quadrotor, as the logs carry them."""

from matplotlib.figure import Figure

from repro.plot import style
from repro.tables.results import Results

NEEDS = {"points": {"quadrotor": ["nominal"]}}
CAPTION = (
    "Table III. The parameters of the quadrotor as the simulation had them. The text says that the "
    "gains of the controller are in this table; they are not, and come from [26]."
)


def draw(results: Results) -> Figure:
    (point,) = NEEDS["points"]["quadrotor"]
    used = results.parameters("quadrotor", point)
    _, angle, _, position = used.measurement_deviations
    roll, pitch, _ = used.inertia
    cells = [
        ["mass m", f"{used.mass:g} kg", "1.023 kg"],
        ["inertia J$_{xx}$, J$_{yy}$", f"{1e3 * roll:g}, {1e3 * pitch:g} g m²", "9.5 g m²"],
        ["deviation of angles σ$_φ$, σ$_θ$, σ$_ψ$", f"{angle:g}°", "0.1°"],
        ["deviation of positions σ$_X$, σ$_Y$, σ$_Z$", f"{position:g} m", "2 m"],
        ["control frequency 1/T", f"{1 / used.period:g} Hz", "100 Hz"],
        ["loss probability p", f"{used.loss_probability:g}", "0.2"],
    ]
    differing = [(place, 1) for place, (_, here, paper) in enumerate(cells) if here != paper]
    return style.table(cells, ("parameter", "here", "paper"), (0.45, 0.3, 0.25), differing)
