"""How many published values and claims reproduce, by paper."""

from repro.plot.verdicts import tally

NEEDS = {"diff": True}
CAPTION = "Published values and claims of each paper by verdict."


def draw(results):
    return tally(results)
