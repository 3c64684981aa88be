"""Claims of Zhang, You, Xie 2018, Sections V and VI (Figures 1-5 and their text)."""

from repro.claims import Claim, _linear_losses, _radar

CLAIMS: list[Claim] = [*_linear_losses.CLAIMS, *_radar.CLAIMS]
