"""Table 1: which packet arrives when, computed from the printed flags."""

import matplotlib.ticker
from matplotlib.figure import Figure

from repro.plot import style
from repro.tables.results import Results

NEEDS = {"tables": ["packet_example"]}
CAPTION = (
    "Redrawing of Table 1 as a picture: an arrow from the step that sends a packet to each step "
    "that uses it."
)
COLOURS = [style.COLOURS[place] for place in (2, 4, 1)]  # by the number of steps a packet is late


def draw(results: Results) -> Figure:
    table = results.table("packet_example")
    used = table["component"].str.removeprefix("k=").astype(int)
    drawn, axes = style.figure(size=(style.WIDTH, 2.5))
    for k, packet in zip(used, table["value"].astype(int), strict=True):
        late = k - packet
        axes.annotate(
            "",
            (k, 0),
            (packet, 1),
            arrowprops={"arrowstyle": "->", "color": COLOURS[late], "lw": 1.5},
        )
        axes.annotate(f"$z_{{{packet}}}$", (k, -0.22), ha="center", fontsize=9)
    never = sorted(set(used) - set(table["value"].astype(int)))
    axes.plot(never, [1] * len(never), "x", color="black", ms=9, label="never arrives")
    for late, name in enumerate(("on time", "one step late or again", "two steps late or again")):
        axes.plot([], [], color=COLOURS[late], label=name)
    axes.set(yticks=[0, 1], yticklabels=["received y(k)", "sent z(k)"], ylim=(-0.4, 1.15))
    axes.set(xlim=(0.4, used.max() + 0.6), xlabel="k")
    axes.xaxis.set_major_locator(matplotlib.ticker.MultipleLocator(1))
    axes.legend(fontsize=7, ncols=4, loc="upper center", bbox_to_anchor=(0.5, 1.2))
    return drawn
