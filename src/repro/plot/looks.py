"""Colour and marker of each filter: the same in every figure, whatever other filters there are."""

from collections.abc import Sequence
from zlib import crc32

# Okabe and Ito's palette, which can be told apart with any kind of colour vision.
BLUE, VERMILLION, GREEN, PINK = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
ORANGE, SKY, BLACK, OLIVE, GREY = "#E69F00", "#56B4E9", "#000000", "#999933", "0.45"
PALETTE = (BLUE, VERMILLION, GREEN, PINK, ORANGE, SKY, BLACK, OLIVE)

# Proposed filters are blue first; what knows the network is green, what ignores it vermillion.
LOOKS = {
    "omvf": (BLUE, "o"),
    "nahi": (VERMILLION, "s"),
    "intermittent_kf": (ORANGE, "^"),
    "sun": (BLACK, "D"),
    "genie": (GREEN, "v"),
    "best_in_form": (PINK, "P"),
    "emvf": (BLUE, "o"),
    "emvf_realised": (SKY, "P"),
    "ekf": (VERMILLION, "s"),
    "iekf": (GREEN, "v"),
    "mapf": (BLUE, "o"),
    "mapf_nc": (ORANGE, "^"),
    "mapf_nmc": (VERMILLION, "s"),
    "mpf": (PINK, "D"),
    "dead_reckoning": (GREY, "None"),
    "pf_ross_eh": (BLUE, "o"),
    "pf_ross": (ORANGE, "^"),
    "pf_eh": (SKY, "D"),
    "spf": (VERMILLION, "s"),
    "spf_im": (GREEN, "v"),
    "pf_ross_eh_exact": (PINK, "P"),
    "pf_ross_eh_joint": (BLACK, "X"),
    "prior": (GREY, "None"),
    "bkf_1": (BLUE, "o"),
    "bkf_2": (ORANGE, "^"),
    "rbpf": (PINK, "D"),
    "rbpf_fast": (OLIVE, "X"),
    "exact": (BLACK, "*"),
    "true_state": (BLACK, "*"),
    "ekf_no_loss": (SKY, "P"),
}
BASELINES = ("dead_reckoning", "prior")  # use no measurement; dashed
# For filters that are not listed: no colour of the above.
RESERVE = (
    ("#882255", "h"),
    ("#44AA99", "p"),
    ("#661100", "8"),
    ("#AA4499", "<"),
    ("#6699CC", ">"),
    ("#DDCC77", "d"),
    ("#332288", "H"),
)


def look(filter_: str, own: Sequence[str]) -> dict[str, str]:
    """Colour, marker, and line style where it is not solid.

    `own` are a reader's own filters, in the order of their rules.
    """
    if filter_ in LOOKS:
        colour, marker = LOOKS[filter_]
    else:
        colour, marker = _reserved(filter_, list(own))
    dashed = {"linestyle": "--"} if filter_ in BASELINES else {}
    return {"color": colour, "marker": marker} | dashed


def _reserved(filter_: str, own: list[str]) -> tuple[str, str]:
    """By place among a reader's own; by name for a filter that a reader's parameter file ranks."""
    place = own.index(filter_) if filter_ in own else crc32(filter_.encode())
    turn, colour = divmod(place, len(RESERVE))  # the second turn has other pairs
    return RESERVE[colour][0], RESERVE[(colour + turn) % len(RESERVE)][1]
