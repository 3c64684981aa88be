"""BKF-I: a Kalman filter on MAP estimates of the losses [unknown_losses Algorithm 1]."""

from typing import Any

from repro.filters import Filter
from repro.filters.families import extended_kalman
from repro.filters.families.extended_kalman import Evidence, Weighed, prior_odds
from repro.models import Model
from repro.network.channels import Seen

LABEL = "BKF-I"
SEES = ("received",)


def build(model: Model, settings: dict[str, Any]) -> Filter:
    prior = prior_odds(model.network)

    def weigh(seen: Seen, evidence: Evidence, last: Any) -> Weighed:
        odds = evidence() + prior(last)  # (9), in logs
        estimated = (odds > 0).astype(float)  # (8)
        return estimated, estimated

    return extended_kalman.build(model, weigh)
