"""Claims on the linear example [packet_delays Sec. 4.1, Figs. 1-2]."""

from repro.papers.packet_delays.claims.errors import squared_error
from repro.papers.packet_delays.points import linear_points
from repro.studies import linear_delays
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, smaller

CLAIMS: list[Claim] = []


def more_accurate(results: Results, first: str, second: str) -> list[Part]:
    """`first` has the smaller mean squared error in every component and at every p < 1."""
    return [
        smaller(
            f"{component}, p={arrival}: {first} - {second}",
            squared_error(results, point, first, i),
            squared_error(results, point, second, i),
        )
        for arrival, point in linear_points(results).items()
        if arrival < 1
        for i, component in enumerate(linear_delays.COMPONENTS)
    ]


@claim(
    CLAIMS,
    "omvf-below-sun",
    "Figs. 1-2: for p < 1 the OMVF is more accurate than the filter of Sun (2009)",
)
def omvf_below_sun(results: Results) -> list[Part]:
    return more_accurate(results, "omvf", "sun")


@claim(
    CLAIMS,
    "omvf-below-sinopoli",
    "Figs. 1-2: for p < 1 the OMVF is more accurate than the filter of Sinopoli et al. (2004)",
)
def omvf_below_sinopoli(results: Results) -> list[Part]:
    return more_accurate(results, "omvf", "intermittent_kf")


@claim(
    CLAIMS,
    "omvf-below-nahi",
    "Figs. 1-2: for p < 1 the OMVF is more accurate than the filter of Nahi (1969)",
)
def omvf_below_nahi(results: Results) -> list[Part]:
    return more_accurate(results, "omvf", "nahi")


@claim(
    CLAIMS,
    "sinopoli-below-nahi",
    "Figs. 1-2: for p < 1 the filter of Sinopoli et al. (2004) is more accurate than Nahi's (1969)",
)
def sinopoli_below_nahi(results: Results) -> list[Part]:
    return more_accurate(results, "intermittent_kf", "nahi")


@claim(
    CLAIMS,
    "sun-below-nahi",
    "Figs. 1-2: for p < 1 the filter of Sun (2009) is more accurate than Nahi's (1969)",
)
def sun_below_nahi(results: Results) -> list[Part]:
    return more_accurate(results, "sun", "nahi")
