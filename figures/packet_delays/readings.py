"""What the unstated choices are worth: SAEE under each reading."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.points import TRACKING, tracking_point
from repro.plot import style
from repro.plot.readings import ROW, draw_readings, readings_of_point
from repro.tables.results import Results

NEEDS = {"tables": ["wsn_tracking"], "diff": True}
CAPTION = (
    "SAEE of the EMVF, and of a reader's own filters, at N = 2, p = 0.9 under one changed "
    "assumption at a time: mean with bars of two standard errors, and median run (cross). The "
    "dotted line is the published value. The EMVF with the realised alpha is (33) as printed. "
    "Every filter: figures/studies/wsn_tracking."
)
BASE = tracking_point(2, "0.9")  # the point that each reading changes in one respect
FILTERS = ("emvf", "emvf_realised")


def draw(results: Results) -> Figure:
    rows = len(readings_of_point(results, TRACKING, BASE))
    drawn, axes = style.figure(size=(style.WIDTH, ROW * rows + 1.4))
    component = results.table(TRACKING).query("metric == 'saee'")["component"].iloc[0]
    draw_readings(axes, results, TRACKING, BASE, "saee", component, FILTERS, "N = 2, p = 0.9")
    published = _published(results)
    axes.axvline(published, color="black", ls=":", lw=1, label=f"published, {published:g} m")
    axes.set_xlabel("SAEE in m")
    drawn.legend(*axes.get_legend_handles_labels(), fontsize=8, ncols=4, loc="outside lower center")
    return drawn


def _published(results: Results) -> float:
    """The entry of Table 2 for the base point, in m."""
    diff = results.diff()
    rows = diff[(diff["study"] == TRACKING) & (diff["point"] == BASE) & (diff["metric"] == "saee")]
    return float(rows["published"].iloc[0])
