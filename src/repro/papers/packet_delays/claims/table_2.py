"""Claims on SAEE [packet_delays Table 2, Remark 6]: how it depends on p and on N."""

from itertools import pairwise

import numpy as np

from repro.papers.packet_delays.claims.errors import mean_error
from repro.papers.packet_delays.points import table_2
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, smaller

CLAIMS: list[Claim] = []
# Columns of Table 2 between those that are compared. At N = 2 one column changes SAEE by so little
# that our runs do not decide it: see the fact `next_column_undecided`.
COLUMNS_APART = {0: 1, 1: 1, 2: 2}


@claim(
    CLAIMS,
    "saee-falls-with-arrival-probability",
    "Table 2: SAEE falls as the arrival probability rises, for every N: its slope over p",
)
def saee_falls_with_arrival_probability(results: Results) -> list[Part]:
    return [
        smaller(f"N={bound}: slope of SAEE over p", slope := _slope(results, bound, row), 0 * slope)
        for bound, row in table_2(results).items()
    ]


@claim(
    CLAIMS,
    "saee-falls-from-column-to-column",
    "Table 2: SAEE falls from column to column, for N = 2 over two columns",
)
def saee_falls_from_column_to_column(results: Results) -> list[Part]:
    return [
        smaller(
            f"N={bound}: SAEE at p={high} - p={low}",
            mean_error(results, bound, high),
            mean_error(results, bound, low),
        )
        for bound, arrivals in table_2(results).items()
        for low, high in zip(arrivals, arrivals[COLUMNS_APART[bound] :], strict=False)
    ]


@claim(
    CLAIMS,
    "saee-falls-with-packet-bound",
    "Table 2: SAEE falls as N rises: its mean over the arrival probabilities",
)
def saee_falls_with_packet_bound(results: Results) -> list[Part]:
    return [
        smaller(f"SAEE at N={more} - N={less}, mean over p", of_more, of_less)
        for less, more, of_less, of_more in _neighbouring_rows(results)
    ]


@claim(
    CLAIMS,
    "saee-falls-with-packet-bound-in-every-column",
    "Table 2: SAEE falls from N = 0 to N = 2 at every arrival probability",
)
def saee_falls_with_packet_bound_in_every_column(results: Results) -> list[Part]:
    """Neighbouring rows are compared in their means only: see the fact `next_row_undecided`."""
    bounds = table_2(results)
    least, most = min(bounds), max(bounds)
    return [
        smaller(
            f"p={arrival}: SAEE at N={most} - N={least}",
            mean_error(results, most, arrival),
            mean_error(results, least, arrival),
        )
        for arrival in bounds[least]
    ]


@claim(
    CLAIMS,
    "later-packets-are-useless",
    "Remark 6: packets that are later than N cannot improve the accuracy",
)
def later_packets_are_useless(results: Results) -> list[Part]:
    return [
        smaller(f"SAEE without packets {more} steps late - with them, N={less}", of_less, of_more)
        for less, more, of_less, of_more in _neighbouring_rows(results)
    ]


def _slope(results: Results, bound: int, arrivals: list[str]) -> np.ndarray:
    """Slope of the straight line through each run's mean errors over p, (trials,), in m."""
    p = np.array(arrivals, dtype=float)
    weights = (p - p.mean()) / ((p - p.mean()) ** 2).sum()
    return (weights[:, None] * _row(results, bound, arrivals)).sum(axis=0)


def _neighbouring_rows(results: Results) -> list[tuple[int, int, np.ndarray, np.ndarray]]:
    """N, the next N, and the mean of each run over the columns of both rows, (trials,), in m."""
    rows = {
        bound: _row(results, bound, arrivals).mean(axis=0)
        for bound, arrivals in table_2(results).items()
    }
    return [(less, more, rows[less], rows[more]) for less, more in pairwise(rows)]


def _row(results: Results, bound: int, arrivals: list[str]) -> np.ndarray:
    """Mean errors of a row of the table, (columns, trials), in m."""
    return np.stack([mean_error(results, bound, arrival) for arrival in arrivals])
