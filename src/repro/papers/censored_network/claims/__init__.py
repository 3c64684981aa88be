"""Claims of censored_network: Tables I and II, Figures 2-15, Remarks 3 and 4."""

from repro.papers.censored_network.claims import limits, orders, ratios
from repro.verdicts.claims import Claim

CLAIMS: list[Claim] = [*orders.CLAIMS, *ratios.CLAIMS, *limits.CLAIMS]
