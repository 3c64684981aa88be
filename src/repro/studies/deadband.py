"""Dead-band censoring (Song et al., (4); Table I, Figures 2-8)."""

# The two studies differ in their parameters alone.
from repro.studies.families.censored_network import *
