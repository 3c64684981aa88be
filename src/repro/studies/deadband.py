"""Dead-band censoring (Song et al., (4); Table I, Figures 2-8)."""

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
