"""Saturation censoring [censored_network (5), Table II, Figs. 9-15]."""

from repro.studies.families.censored_network import CensoredNetwork

STUDY = CensoredNetwork()
