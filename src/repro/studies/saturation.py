"""Saturation censoring (Song et al., (5); Table II, Figures 9-15)."""

# The two studies differ in their parameters alone.
from repro.studies._censored_network import *  # noqa: F403
