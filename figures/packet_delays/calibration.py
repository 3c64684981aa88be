"""q, the channel and S(0), fitted again to Table 2. On request."""

from matplotlib.figure import Figure

from repro.plot import style
from repro.tables.results import Results

NEEDS = {"calibration": ["table_2"], "on_request": True}
CAPTION = (
    "Misfit to Table 2, the root mean square of ln(ours / printed) over its 15 values, over the "
    "turn-rate variance q that the EMVF assumes, for both channels and every S(0), with bars of "
    "two standard errors. Squares: not told apart from the best by three standard errors of "
    "the paired difference. Ring: what this project runs with. Dotted: the printed q = 0.2."
)
PRINTED = 0.2  # (rad/s)^2, Sec. 4.2.2
NAMES = {"theorem_2": "Theorem 2", "P0": "as printed, P(0|0)", "matched": "matched spread"}


def draw(results: Results) -> Figure:
    table = results.calibration("table_2")
    drawn, grid = style.figure(1, 2, size=(style.WIDTH, 4.0), sharey=True)
    for (channel, rows), axes in zip(table.groupby("channel", sort=False), grid, strict=True):
        for moment, of_moment in rows.groupby("initial_second_moment", sort=False):
            axes.errorbar(
                of_moment["turn_rate_variance"],
                of_moment["misfit"],
                style.bars(of_moment["misfit"], of_moment["mcse"]),
                fmt="o-",
                ms=4,
                capsize=2,
                label=f"S(0): {NAMES[moment]}",
            )
        equal = rows[rows["equal"]]
        axes.plot(
            equal["turn_rate_variance"],
            equal["misfit"],
            "ks",
            ms=4,
            zorder=5,
            label="not told apart from the best",
        )
        chosen = rows[rows["chosen"]]
        axes.plot(
            chosen["turn_rate_variance"], chosen["misfit"], "o", ms=12, mfc="none", mec="black"
        )
        axes.axvline(PRINTED, color="black", ls=":", lw=1)
        axes.set(
            xscale="log",
            yscale="log",
            xlabel=r"q in (rad/s)$^2$",
            title=f"channel {channel}, {rows['trials'].iloc[0]} trials",
        )
    grid[0].set_ylabel("misfit to Table 2")
    grid[0].legend(fontsize=8)
    return drawn
