"""Claims of packet_delays: Tables 1-2, Figures 1-10, the remarks, and the text on them."""

from repro.papers.packet_delays.claims import (
    linear_delays,
    remarks,
    table_2,
    theorem_1,
    wsn_tracking,
)
from repro.verdicts.claims import Claim

CLAIMS: list[Claim] = [
    *table_2.CLAIMS,
    *wsn_tracking.CLAIMS,
    *linear_delays.CLAIMS,
    *theorem_1.CLAIMS,
    *remarks.CLAIMS,
]
