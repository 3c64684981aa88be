"""Which filter is better: Tables I and II, Figures 2-15 of censored_network."""

from itertools import product

from repro.papers.censored_network.time_averages import (
    CENSORING,
    OTHER_AVERAGES,
    POINT,
    Average,
    time_average,
)
from repro.statistics import metrics
from repro.statistics.paired import independent_error
from repro.studies.deadband import STUDY  # that of `saturation` is the same
from repro.studies.families.censored_network import COMPONENTS, TARGETS
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, claim, most

CLAIMS: list[Claim] = []


def difference(
    results: Results,
    study: str,
    first: str,
    second: str,
    component: int = -1,
    average: Average = time_average,
) -> Part:
    """The RMSE of `first` is below that of `second`, paired over the runs."""
    a, b = (average(results, study, filter_) for filter_ in (first, second))
    error = metrics.jackknife_error(a.left_out - b.left_out)
    return Part(
        f"{CENSORING[study]}, {COMPONENTS[component]}: {first} - {second}",
        float((a.value - b.value)[component]),
        float(error[component]),
    )


@claim(
    CLAIMS,
    "mapf-below-dead-reckoning",
    "Figs. 2-4, 9-11: MAPF tracks every target with a smaller error than dead reckoning.",
)
def mapf_below_dead_reckoning(results: Results) -> list[Part]:
    return [
        difference(results, study, "mapf", "dead_reckoning", i)
        for study, i in product(CENSORING, range(len(TARGETS)))
    ]


@claim(
    CLAIMS,
    "mapf-error-bounded",
    "Figs. 2-4, 9-11: the error of MAPF stays bounded in most runs.",
)
def mapf_error_bounded(results: Results) -> list[Part]:
    parts = []
    for study, words in CENSORING.items():
        analysis = results.analysis(study)
        lost = results.each(study, POINT, "mapf", lambda runs, a=analysis: STUDY.lost(runs, a))
        parts.append(most(f"{words}: no target's error above {analysis.lost_above:g} m", ~lost))
    return parts


@claim(
    CLAIMS,
    "mapf-below-nc",
    "Tables I-II: MAPF, which models the coupling, has a smaller average RMSE than MAPF-NC.",
)
def mapf_below_nc(results: Results) -> list[Part]:
    return [difference(results, study, "mapf", "mapf_nc") for study in CENSORING]


@claim(
    CLAIMS,
    "nc-below-nmc",
    "Tables I-II: ignoring the censoring costs more than ignoring the coupling.",
)
def nc_below_nmc(results: Results) -> list[Part]:
    return [difference(results, study, "mapf_nc", "mapf_nmc") for study in CENSORING]


@claim(
    CLAIMS,
    "mapf-below-mpf",
    "Tables I-II: auxiliary resampling gives a smaller average RMSE than standard resampling.",
)
def mapf_below_mpf(results: Results) -> list[Part]:
    return [difference(results, study, "mapf", "mpf") for study in CENSORING]


@claim(
    CLAIMS,
    "mapf-best-for-every-target",
    "Figs. 6-8, 13-15: MAPF has the smallest error of the four filters for every target.",
)
def mapf_best_for_every_target(results: Results) -> list[Part]:
    return [
        difference(results, study, "mapf", other, i)
        for study, other, i in product(
            CENSORING, ("mapf_nc", "mapf_nmc", "mpf"), range(len(TARGETS))
        )
    ]


@claim(
    CLAIMS,
    "orders-under-other-averages",
    "Tables I-II: MAPF is below MAPF-NC, and MAPF-NC below MAPF-NMC, also if k = 0 enters the "
    "average, and if the root is taken of the average over k.",
)
def orders_under_other_averages(results: Results) -> list[Part]:
    parts = []
    for study, (words, average) in product(CENSORING, OTHER_AVERAGES.items()):
        for first, second in (("mapf", "mapf_nc"), ("mapf_nc", "mapf_nmc")):
            part = difference(results, study, first, second, average=average)
            parts.append(part._replace(name=f"{words}: {part.name}"))
    return parts


@claim(
    CLAIMS,
    "saturation-below-dead-band",
    "Tables I-II: the average RMSE is smaller under saturation than under the dead band for "
    "MAPF, MAPF-NC and MPF, and larger for MAPF-NMC.",
)
def saturation_below_dead_band(results: Results) -> list[Part]:
    parts = []
    for filter_, sign in (("mapf", 1), ("mapf_nc", 1), ("mpf", 1), ("mapf_nmc", -1)):
        dead_band, saturation = (
            time_average(results, study, filter_) for study in ("deadband", "saturation")
        )
        error = independent_error(dead_band.mcse()[-1], saturation.mcse()[-1])
        words = "saturation - dead band" if sign > 0 else "dead band - saturation"
        gap = sign * (saturation.value - dead_band.value)[-1]
        parts.append(Part(f"{filter_}: {words}", float(gap), error))
    return parts
