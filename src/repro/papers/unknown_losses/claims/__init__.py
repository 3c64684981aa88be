"""Claims of unknown_losses, Sections IV to VI with Figures 1-5 and 8-10."""

from repro.papers.unknown_losses.claims import inference, linear_losses, particles, quadrotor, radar
from repro.verdicts.claims import Claim

CLAIMS: list[Claim] = [
    *linear_losses.CLAIMS,
    *particles.CLAIMS,
    *inference.CLAIMS,
    *radar.CLAIMS,
    *quadrotor.CLAIMS,
]
