"""BKF-II: both hypotheses of a loss, merged [unknown_losses Algorithm 2].

The text below (11) takes lambda(k-1) for the prior of gamma(k). Lambda is then its own prior and
soon stays at 0 or 1. The default prior is that of the loss process instead.
"""

from typing import Any

from repro.filters import Filter
from repro.filters.families import extended_kalman
from repro.filters.families.extended_kalman import Evidence, Weighed, prior_odds
from repro.kernels import arrays
from repro.models import Model
from repro.network.channels import Seen
from repro.parameters.settings import MergedHypotheses

LABEL = "BKF-II"
SEES = ("received",)


def build(model: Model, settings: MergedHypotheses) -> Filter:
    """Setting `prior`: theta (of the loss process), or lambda(k-1) as printed below (11)."""
    prior, literal = prior_odds(model.network), settings.prior == "lambda(k-1)"

    def weigh(seen: Seen, evidence: Evidence, last: Any) -> Weighed:
        # Of lambda(k-1) the log odds are kept: lambda itself would round to 0 or 1.
        odds = evidence() + (last if literal and last is not None else prior(last))
        arrived = 1 / (1 + arrays.exp(-odds))  # lambda(k) of (11)
        return arrived, odds if literal else arrived

    return extended_kalman.build(model, weigh, spread=True)  # (12), (13)
