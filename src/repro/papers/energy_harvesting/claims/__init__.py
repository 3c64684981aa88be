"""Claims of [energy_harvesting]: Figures 2-13 and their text, Lemma 1, Remarks 3 to 5."""

from repro.papers.energy_harvesting.claims import (
    accuracy,
    battery,
    lemma_1,
    reductions,
    remarks,
    worst_filter,
)
from repro.verdicts.claims import Claim

CLAIMS: list[Claim] = [
    *accuracy.CLAIMS,
    *battery.CLAIMS,
    *worst_filter.CLAIMS,
    *reductions.CLAIMS,
    *lemma_1.CLAIMS,
    *remarks.CLAIMS,
]
