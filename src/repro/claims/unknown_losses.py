"""Claims of Zhang, You, Xie 2018, Sections V and VI (Figures 1-5, 8-10 and their text)."""

from repro.claims import Claim, _linear_losses, _quadrotor, _radar

CLAIMS: list[Claim] = [*_linear_losses.CLAIMS, *_radar.CLAIMS, *_quadrotor.CLAIMS]
