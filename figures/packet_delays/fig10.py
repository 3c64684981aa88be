"""Figure 10: estimation error of the EMVF, p = 0.90."""

from repro.papers.packet_delays.tracks import error_over_k, first_trial, missed_steps

NEEDS = {
    "tables": ["wsn_tracking"],
    "points": {"wsn_tracking": ["n1-arrival=0.9", "n2-arrival=0.9"]},
}
CAPTION = (
    "Figure 10: estimation error of the EMVF, p = 0.90. The first run in which seven packets "
    "are late or lost, as in the paper."
)


def draw(results):
    missed = missed_steps(results, "0.9")
    trial = first_trial(missed[:, 1:].sum(axis=1) == 7)
    return error_over_k(
        results,
        "0.9",
        trial,
        ekf=False,
        published={"Fig. 10, N = 1: 17.5 m": (17.5, 17.5), "Fig. 10, N = 2: 7 to 8 m": (7.0, 8.0)},
    )
