"""Claims about the transmission probability [energy_harvesting Lemma 1, Remark 3]."""

import numpy as np

from repro.papers.energy_harvesting.claims.transmissions import probability, share_sent
from repro.papers.energy_harvesting.compared import HARVESTS, SWEPT_STUDY
from repro.statistics import metrics
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim

CLAIMS: list[Claim] = []


@claim(
    CLAIMS,
    "lemma-1-gives-transmission-probability",
    "Lemma 1: Its lambda is the probability that a sensor transmits.",
)
def lemma_1_is_right(results: Results) -> list[Part]:
    parts = []
    for point in HARVESTS.points:
        lemma, exact = (
            probability(results, SWEPT_STUDY, point, rule) for rule in ("lemma1", "exact")
        )
        name, rounding = f"{SWEPT_STUDY} {point}", results.analysis(SWEPT_STUDY).rounding
        parts.append(below(f"{name}: largest error", np.abs(lemma - exact).max(), rounding))
        apart = (share_sent(results, SWEPT_STUDY, point) - lemma).mean(axis=1)  # of each trial
        margin = results.tolerance * metrics.mean_error(apart)
        text = f"{name}: |logs - Lemma 1| - {results.tolerance:g} standard errors"
        parts.append(Part(text, float(abs(apart.mean()) - margin), 0.0))
    return parts


@claim(
    CLAIMS,
    "lemma-1-exact-for-identity-matrix",
    "Remark 3: For an identity matrix Pi, Lemma 1 reduces to the exact one of Shen et al. (2019).",
)
def identity_is_the_reduction(results: Results) -> list[Part]:
    lemma, exact = (
        probability(results, "ungm", "harvest=identity", rule) for rule in ("lemma1", "exact")
    )
    largest, rounding = np.abs(lemma - exact).max(), results.analysis("ungm").rounding
    return [below("largest error of Lemma 1 for Pi = I", largest, rounding)]
