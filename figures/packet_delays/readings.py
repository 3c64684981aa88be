"""What the unstated choices are worth: SAEE of the EMVF at N = 2, p = 0.9 under each reading."""

import numpy as np

from repro.plot import style

NEEDS = {"tables": ["wsn_tracking"]}
CAPTION = (
    "SAEE of the EMVF at N = 2, p = 0.9 under one changed assumption at a time: mean with standard "
    "error, and median. The dotted line is the published 3.54 m."
)


def draw(results):
    table = results.table("wsn_tracking")
    table = table[(table["metric"] == "saee") & table["filter"].str.startswith("emvf")]
    base = table[table["point"] == "n2-arrival=0.9"]
    readings = table[
        table["point"].str.startswith("reading-")
        & ((table["filter"] == "emvf_realised") == table["point"].str.contains("indicator_of"))
    ]
    rows = [*base.itertuples(), *readings.itertuples()]
    names = {"emvf": "base", "emvf_realised": "indicator_of=k (as printed)"}
    drawn, axes = style.figure(size=(7.4, 5.2))
    for place, row in enumerate(rows):
        axes.errorbar(row.value, place, xerr=row.mcse, fmt="o", color=style.COLOURS[0], capsize=3)
        axes.plot(row.median, place, "x", color=style.COLOURS[1])
    labels = [
        names[row.filter] if row.point == "n2-arrival=0.9" else row.point.removeprefix("reading-")
        for row in rows
    ]
    axes.plot([], [], "o", color=style.COLOURS[0], label="mean ± standard error")
    axes.plot([], [], "x", color=style.COLOURS[1], label="median")
    axes.axvline(3.54, color="black", ls=":", lw=1, label="published, 3.54 m")
    axes.set(yticks=np.arange(len(rows)), yticklabels=labels, xscale="log", xlabel="SAEE in m")
    axes.invert_yaxis()
    axes.legend(fontsize=8)
    return drawn
