"""Claims of Zhang, You, Xie 2018, Sections V and VI (Figures 1-5, 8-10 and their text)."""

from repro.papers.unknown_losses.claims import linear_losses, quadrotor, radar
from repro.verdicts.claims import Claim

CLAIMS: list[Claim] = [*linear_losses.CLAIMS, *radar.CLAIMS, *quadrotor.CLAIMS]
