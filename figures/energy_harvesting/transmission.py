"""The transmission probability by Lemma 1, by the exact chain, and as simulated."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.drawings import transmission
from repro.plot import style
from repro.tables.results import Results

NEEDS = {
    "points": {"rss_2d": ["base", "harvest=pi_2"], "ungm": ["harvest=identity"]},
}
CAPTION = (
    "Transmission probability over k by Lemma 1, by the exact chain of (E, H), and as simulated, "
    "with its band. Lemma 1 assumes that E(k-1) and H(k) are independent, which they are only if "
    "the rows of the harvest's transition matrix are identical."
)
LAST = 30  # last step drawn


def draw(results: Results) -> Figure:
    drawn, grid = style.figure(1, 3, size=(style.WIDTH, 3.6), sharey=True)
    for axes, (study, point, title) in zip(
        grid,
        (
            ("rss_2d", "base", r"$\Pi_1$"),
            ("rss_2d", "harvest=pi_2", r"$\Pi_2$"),
            ("ungm", "harvest=identity", r"$\Pi = I$ (Remark 3)"),
        ),
        strict=True,
    ):
        transmission(axes, results, study, point, LAST)
        runs = len(results.log(study, point).trials)
        axes.set(title=f"{title}, {runs} runs", xlabel="k")
        axes.title.set_fontsize(9.5)
    grid[0].set_ylabel(r"$\lambda_k$, probability to transmit")
    drawn.legend(
        *grid[0].get_legend_handles_labels(), fontsize=8, ncols=3, loc="outside lower center"
    )
    return drawn
