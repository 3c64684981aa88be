"""Claims of the remarks on OMVF and EMVF [packet_delays Remarks 2, 3, 5]."""

from repro.filters import emvf, omvf
from repro.papers.packet_delays.claims.errors import compared, equal
from repro.papers.packet_delays.points import LINEAR, TRACKING, linear_points
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim

CLAIMS: list[Claim] = []


@claim(
    CLAIMS,
    "omvf-and-emvf-need-no-arrivals",
    "Remarks 2 and 5: OMVF and EMVF need the arrival probability, not the arrivals",
)
def omvf_and_emvf_need_no_arrivals(results: Results) -> list[Part]:
    return [
        below(
            f"{filter_.LABEL}: number of channels besides y",
            len(set(filter_.SEES) - {"received"}),
            0.5,
        )
        for filter_ in (omvf, emvf)
    ]


@claim(
    CLAIMS,
    "omvf-equals-kalman-without-losses",
    "Remark 3: at p = 1 the OMVF is the Kalman filter",
)
def omvf_equals_kalman_without_losses(results: Results) -> list[Part]:
    point = linear_points(results)[1.0]
    first, second = (
        results.runs(LINEAR, point, filter_).error for filter_ in ("omvf", "intermittent_kf")
    )
    return [equal("errors", first, second, results.analysis(LINEAR).equal_within)]


@claim(CLAIMS, "emvf-equals-ekf-without-losses", "Remark 3: at p = 1 the EMVF is the EKF")
def emvf_equals_ekf_without_losses(results: Results) -> list[Part]:
    first, second, tracked = compared(results, (1, "emvf"), (1, "ekf"))
    relative = results.analysis(TRACKING).equal_within
    return [equal("errors of the runs that track", first[tracked], second[tracked], relative)]
