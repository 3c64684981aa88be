"""Saturation censoring (Song et al., (5); Table II, Figures 9-15)."""

from repro.studies._censored_network import (
    TRAJECTORY,
    TRIALS_A_BLOCK,
    channels,
    curves,
    error,
    lost,
    model,
    period,
    rows,
    simulate,
    topics,
)

__all__ = [
    "TRAJECTORY",
    "TRIALS_A_BLOCK",
    "channels",
    "curves",
    "error",
    "lost",
    "model",
    "period",
    "rows",
    "simulate",
    "topics",
]
