"""Dead-band censoring [censored_network (4), Table I, Figs. 2-8]."""

from repro.studies.families.censored_network import CensoredNetwork

STUDY = CensoredNetwork()
