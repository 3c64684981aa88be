"""What the unstated choices are worth: SAEE under each reading."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.packet_delays.points import TRACKING, tracking_point
from repro.parameters.point_names import OF
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"tables": ["wsn_tracking"], "diff": True}
CAPTION = (
    "SAEE of the EMVF, and of a reader's own filters, at N = 2, p = 0.9 under one changed "
    "assumption at a time: mean with standard error, and median (cross). The dotted line is the "
    "published value. Every filter: figures/studies/wsn_tracking."
)
BASE = tracking_point(2, "0.9")  # the point that each reading changes in one respect
BEFORE, OF_BASE = "reading-", f"{OF}{BASE}"


def draw(results: Results) -> Figure:
    table = results.table(TRACKING)
    saee = table[table["metric"] == "saee"]
    table = saee[saee["filter"].isin(["emvf", "emvf_realised"])]
    base = table[table["point"] == BASE]
    readings = table[
        table["point"].str.startswith(BEFORE)
        & table["point"].str.endswith(OF_BASE)
        & ((table["filter"] == "emvf_realised") == table["point"].str.contains("indicator_of"))
    ]
    rows = [*base.itertuples(), *readings.itertuples()]
    names = {"emvf": "base", "emvf_realised": "indicator_of=k (as printed)"}
    drawn, axes = style.figure(size=(7.4, 5.2))
    for shift, filter_ in enumerate(results.own_filters, start=1):
        own = saee[saee["filter"] == filter_].set_index("point")
        look, there = style.look(results, filter_), []
        for place, point in enumerate(row.point for row in rows):
            if point in own.index and point not in there:
                at, row = place + 0.2 * shift, own.loc[point]
                axes.errorbar(row["value"], at, xerr=row["mcse"], **look, ms=4, capsize=3)
                axes.plot(row["median"], at, "x", color=look["color"])
                there.append(point)
        if there:
            axes.plot([], [], **look, ls="none", label=style.label(filter_))
    for place, row in enumerate(rows):
        axes.errorbar(row.value, place, xerr=row.mcse, fmt="o", color=style.COLOURS[0], capsize=3)
        axes.plot(row.median, place, "x", color=style.COLOURS[1])
    labels = [
        names[row.filter]
        if row.point == BASE
        else row.point.removeprefix(BEFORE).removesuffix(OF_BASE)
        for row in rows
    ]
    axes.plot([], [], "o", color=style.COLOURS[0], label="EMVF, mean ± standard error")
    axes.plot([], [], "x", color=style.COLOURS[1], label="median")
    published = _published(results)
    axes.axvline(published, color="black", ls=":", lw=1, label=f"published, {published:g} m")
    axes.set(yticks=np.arange(len(rows)), yticklabels=labels, xscale="log", xlabel="SAEE in m")
    axes.invert_yaxis()
    axes.legend(fontsize=8)
    return drawn


def _published(results: Results) -> float:
    """The entry of Table 2 for the base point, in m."""
    diff = results.diff()
    rows = diff[(diff["study"] == TRACKING) & (diff["point"] == BASE) & (diff["metric"] == "saee")]
    return float(rows["published"].iloc[0])
