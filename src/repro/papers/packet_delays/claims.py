"""Claims of Liu, Xu, Shi 2012 (Tables 1-2, Figures 1-10 and their text)."""

from itertools import pairwise

import numpy as np

from repro.filters import emvf, omvf
from repro.studies import linear_delays, wsn_tracking
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, most, smaller

CLAIMS: list[Claim] = []
TABLE_2_P = (0.8, 0.85, 0.9, 0.95, 0.99)
TABLE_2_N = (0, 1, 2)
LOSSY_P = [f"{i / 10}" for i in range(1, 10)]  # p < 1 of Figures 1 and 2
ROUNDING = 1e-6  # relative size of what rounding may leave between filters that are equal


def saee(results: Results, bound: int, p: float) -> np.ndarray:
    """Mean position error of each run of the EMVF, (trials,)."""
    return results.each(
        "wsn_tracking",
        f"n{bound}-arrival={p}",
        "emvf",
        lambda runs: wsn_tracking.position_error(runs)[:, 1:].mean(axis=1),
    )


def largest(results: Results, bound: int, p: float, filter_: str) -> np.ndarray:
    """Largest position error of each run, (trials,)."""
    return results.each(
        "wsn_tracking",
        f"n{bound}-arrival={p}",
        filter_,
        lambda runs: wsn_tracking.position_error(runs)[:, 1:].max(axis=1),
    )


def missed(results: Results, bound: int, p: float) -> np.ndarray:
    """Number of steps of each run whose packet is late or lost, (trials,)."""
    return results.each_log(
        "wsn_tracking",
        f"n{bound}-arrival={p}",
        lambda log: (log.field("/network", "delay")[:, 1:] != 0).sum(axis=1),
    )


def squared_error(results: Results, p: str, filter_: str, component: int) -> np.ndarray:
    """Mean squared error of each run, (trials,)."""
    return results.each(
        "linear_delays",
        f"arrival={p}",
        filter_,
        lambda runs: (runs.error[:, 1:, component] ** 2).mean(axis=1),
    )


def better(results: Results, first: str, second: str) -> list[Part]:
    """`first` has the smaller mean squared error in every component and at every p < 1."""
    return [
        smaller(
            f"{component}, p={p}: {first} - {second}",
            squared_error(results, p, first, i),
            squared_error(results, p, second, i),
        )
        for p in LOSSY_P
        for i, component in enumerate(linear_delays.COMPONENTS)
    ]


def equal(what: str, first: np.ndarray, second: np.ndarray) -> Part:
    """Two filters that must agree do so up to rounding."""
    return below(what, np.abs(first - second).max(), ROUNDING * max(1.0, np.abs(second).max()))


@claim(CLAIMS, "D-C1 p", "Table 2: SAEE falls as the arrival probability rises, for every N")
def saee_falls_with_p(results):
    return [
        smaller(f"N={n}: SAEE at p={high} - p={low}", saee(results, n, high), saee(results, n, low))
        for n in TABLE_2_N
        for low, high in pairwise(TABLE_2_P)
    ]


@claim(CLAIMS, "D-C1 N", "Table 2: SAEE falls as N rises, at every arrival probability")
def saee_falls_with_n(results):
    return [
        smaller(
            f"p={p}: SAEE at N={more} - N={less}", saee(results, more, p), saee(results, less, p)
        )
        for p in TABLE_2_P
        for less, more in pairwise(TABLE_2_N)
    ]


@claim(CLAIMS, "D-C2 small", "Figs. 3-4: at p = 1 the errors of EKF and EMVF stay below 0.3 m")
def small_errors_without_loss(results):
    return [
        most(f"N={n}, {name}: largest error < 0.3 m", largest(results, n, 1, name) < 0.3)
        for n, name in ((1, "ekf"), (1, "emvf"), (2, "emvf"))
    ]


@claim(CLAIMS, "D-C2 equal", "Fig. 4: at p = 1 the EMVF is the same for N = 1 and N = 2")
def equal_without_loss(results):
    first, second = (results.runs("wsn_tracking", f"n{n}-arrival=1", "emvf").error for n in (1, 2))
    tracked = ~_diverged(first) & ~_diverged(second)
    return [
        equal("estimates of the runs that track", first[tracked], second[tracked]),
        most("run counts among those that track", tracked),
    ]


def _diverged(error: np.ndarray) -> np.ndarray:
    """Runs that lose the target: there rounding grows without bound, (trials,)."""
    return (np.hypot(error[:, :, 0], error[:, :, 1]) > wsn_tracking.LOST_ABOVE).any(axis=1)


@claim(
    CLAIMS, "D-C3 EKF", "Figs. 5-6: at p = 0.98 the EKF errs far more than the EMVF after a loss"
)
def ekf_worse_after_loss(results):
    hit = missed(results, 1, 0.98) > 0
    return [
        most(
            f"N={n}: largest error of the EMVF below the EKF's, runs with a late or lost packet",
            (largest(results, n, 0.98, "emvf") < largest(results, n, 0.98, "ekf"))[hit],
        )
        for n in (1, 2)
    ]


@claim(CLAIMS, "D-C3 EMVF", "Figs. 5-6: at p = 0.98 the EMVF still tracks the target")
def emvf_tracks(results):
    return [
        most(f"N={n}: largest error < 10 m", largest(results, n, 0.98, "emvf") < 10) for n in (1, 2)
    ]


@claim(CLAIMS, "D-C4", "Text: at p = 0.95 and 0.90 the EKF loses the target")
def ekf_loses_target(results):
    return [
        most(f"N={n}, p={p}: largest error of the EKF > 10 m", largest(results, n, p, "ekf") > 10)
        for p in (0.95, 0.9)
        for n in (1, 2)
    ]


@claim(CLAIMS, "D-C5", "Figs. 7-10: at p = 0.95 and 0.90 N = 2 tracks better than N = 1")
def more_consecutive_losses_better(results):
    return [
        most(
            f"p={p}: largest error smaller with N=2",
            largest(results, 2, p, "emvf") < largest(results, 1, p, "emvf"),
        )
        for p in (0.95, 0.9)
    ]


@claim(
    CLAIMS, "D-C6", "Fig. 10: seven packets missed, largest error 17.5 m (N=1) and 7 to 8 m (N=2)"
)
def figure_10_is_typical(results):
    parts = []
    for bound, low, high in ((1, 17.5, 17.5), (2, 7.0, 8.0)):
        alike = largest(results, bound, 0.9, "emvf")[missed(results, bound, 0.9) == 7]
        rank = (alike < (low + high) / 2).mean()
        error = np.sqrt(rank * (1 - rank) / len(alike))
        name = f"N={bound}: quantile {rank:.3f} of {len(alike)} runs with seven missed packets"
        parts.append(Part(f"{name} is above 0.05", 0.05 - rank, error))
        parts.append(Part(f"{name} is below 0.95", rank - 0.95, error))
    return parts


@claim(CLAIMS, "D-C7 [21]", "Figs. 1-2: for p < 1 the OMVF is more accurate than [21]")
def omvf_beats_sun(results):
    return better(results, "omvf", "sun")


@claim(CLAIMS, "D-C7 [8]", "Figs. 1-2: for p < 1 the OMVF is more accurate than [8]")
def omvf_beats_intermittent(results):
    return better(results, "omvf", "intermittent_kf")


@claim(CLAIMS, "D-C7 [2]", "Figs. 1-2: for p < 1 the OMVF is more accurate than [2]")
def omvf_beats_nahi(results):
    return better(results, "omvf", "nahi")


@claim(CLAIMS, "D-C8/9 [8]", "Figs. 1-2: for p < 1 [8] is more accurate than [2]")
def intermittent_beats_nahi(results):
    return better(results, "intermittent_kf", "nahi")


@claim(CLAIMS, "D-C8/9 [21]", "Figs. 1-2: for p < 1 [21] is more accurate than [2]")
def sun_beats_nahi(results):
    return better(results, "sun", "nahi")


@claim(
    CLAIMS, "D-C10", "Remarks 2, 5: OMVF and EMVF need the arrival probability, not the arrivals"
)
def arrivals_not_needed(results):
    return [
        below(
            f"{filter_.LABEL}: channels seen besides y",
            len(set(filter_.SEES) - {"received"}),
            0.5,
        )
        for filter_ in (omvf, emvf)
    ]


@claim(CLAIMS, "D-C11 linear", "Remark 3: at p = 1 the OMVF is the Kalman filter")
def omvf_is_kalman(results):
    runs = [results.runs("linear_delays", "arrival=1.0", f) for f in ("omvf", "intermittent_kf")]
    return [equal("estimates", *(r.error for r in runs))]


@claim(CLAIMS, "D-C11 tracking", "Remark 3: at p = 1 the EMVF is the EKF")
def emvf_is_ekf(results):
    first, second = (results.runs("wsn_tracking", "n1-arrival=1", f).error for f in ("emvf", "ekf"))
    tracked = ~_diverged(first) & ~_diverged(second)
    return [equal("estimates of the runs that track", first[tracked], second[tracked])]
