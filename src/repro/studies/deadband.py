"""Dead-band censoring (Song et al., (4); Table I, Figures 2-8)."""

# The two studies differ in their parameters alone.
from repro.studies._censored_network import *  # noqa: F403
