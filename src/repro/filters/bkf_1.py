"""BKF-I: a Kalman filter on MAP estimates of the losses (Zhang, You, Xie 2018, Algorithm 1)."""

from repro.filters import Filter
from repro.filters.families import extended_kalman
from repro.models import Model
from repro.network.losses import log_odds

LABEL = "BKF-I"
SEES = ("received",)


def build(model: Model, settings: dict) -> Filter:
    chain = model.network

    def weigh(seen, evidence, last):
        odds = evidence() + log_odds(chain.arrival(last))  # (9), in logs
        estimated = (odds > 0).astype(float)  # (8)
        return estimated, estimated

    return extended_kalman.build(model, weigh)
