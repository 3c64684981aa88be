"""Saturation censoring (Song et al., (5); Table II, Figures 9-15)."""

# The two studies differ in their parameters alone.
from repro.studies.families.censored_network import *
