"""Colour and marker of each filter: the same in every figure, whatever other filters there are."""

from collections.abc import Sequence
from zlib import crc32

import numpy as np
from matplotlib import colors

# Okabe and Ito's palette, which can be told apart with any kind of colour vision.
BLUE, VERMILLION, GREEN, PINK = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
ORANGE, SKY, BLACK, OLIVE, GREY = "#E69F00", "#56B4E9", "#000000", "#999933", "0.45"
PALETTE = (BLUE, VERMILLION, GREEN, PINK, ORANGE, SKY, BLACK, OLIVE)

DARK = "0.2"

# Colour by what a filter is: proposed ones blue, what knows the network green, what ignores it
# vermillion. The marker makes the pair a filter's own over all studies.
LOOKS = {
    "omvf": (BLUE, "o"),
    "emvf": (BLUE, "s"),
    "mapf": (BLUE, "^"),
    "pf_ross_eh": (BLUE, "D"),
    "bkf_1": (BLUE, "v"),
    "nahi": (VERMILLION, "s"),
    "ekf": (VERMILLION, "o"),
    "mapf_nmc": (VERMILLION, "v"),
    "spf": (VERMILLION, "^"),
    "genie": (GREEN, "v"),
    "iekf": (GREEN, "^"),
    "spf_im": (GREEN, "s"),
    "intermittent_kf": (ORANGE, "^"),
    "mapf_nc": (ORANGE, "D"),
    "bkf_2": (ORANGE, "s"),
    "pf_ross": (ORANGE, "o"),
    "best_in_form": (PINK, "P"),
    "mpf": (PINK, "s"),
    "rbpf": (PINK, "D"),
    "pf_ross_eh_exact": (PINK, "p"),
    "emvf_realised": (SKY, "P"),
    "pf_eh": (SKY, "v"),
    "ekf_no_loss": (SKY, "D"),
    "sir_losses": (SKY, "h"),
    "rbpf_fast": (OLIVE, "X"),
    "sun": (BLACK, "D"),
    "exact": (BLACK, "*"),
    "true_state": (BLACK, "P"),
    "pf_ross_eh_joint": (BLACK, "X"),
    "prior": (GREY, "None"),
    "dead_reckoning": (DARK, "None"),
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
LIGHTEST, DARKEST = 0.5, 0.55  # shares of white and black in the outermost shades


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


def shades(colour: str, number: int) -> list[str]:
    """One hue from light to dark, for the values of a parameter; the middle is `colour`."""
    rgb = np.array(colors.to_rgb(colour))
    drawn = []
    for place in np.linspace(-LIGHTEST, DARKEST, number) if number > 1 else [0.0]:
        red, green, blue = rgb - place * (1 - rgb) if place < 0 else rgb * (1 - place)
        drawn.append(colors.to_hex((red, green, blue)))
    return drawn
