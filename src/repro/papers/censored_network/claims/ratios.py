"""What ignoring a part of the model costs: ratios of averages of Tables I and II."""

import numpy as np

from repro.papers.censored_network.time_averages import CENSORING, POINT, PUBLISHED, time_average
from repro.statistics import metrics
from repro.statistics.paired import independent_error
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim
from repro.verdicts.equivalence import equivalent
from repro.verdicts.published import read_published

CLAIMS: list[Claim] = []
RATIO_DIGITS = 3  # decimals of a ratio of two averages that are printed with four


def published_ratio(study: str, filter_: str) -> tuple[float, int]:
    """Ratio of a filter's published average RMSE to that of MAPF, and the number of runs."""
    rows = read_published(PUBLISHED)
    averages = rows[
        (rows["study"] == study)
        & (rows["point"] == POINT)
        & (rows["metric"] == "rmse")
        & (rows["component"] == "average")
    ].set_index("filter")
    of_filter, of_mapf = (float(averages.at[name, "value"]) for name in (filter_, "mapf"))
    return round(of_filter / of_mapf, RATIO_DIGITS), int(averages.at[filter_, "trials"])


def ratio_to_mapf(results: Results, study: str, filter_: str) -> tuple[float, float]:
    """Average RMSE of a filter over that of MAPF, and its jackknife standard error."""
    a, b = (time_average(results, study, name) for name in (filter_, "mapf"))
    left_out = a.left_out[:, -1] / b.left_out[:, -1]
    return float(a.value[-1] / b.value[-1]), float(metrics.jackknife_error(left_out))


def ratios_as_published(results: Results, filter_: str) -> list[Part]:
    """The ratio of a filter to MAPF is the published one, within both Monte Carlo errors."""
    parts = []
    for study, words in CENSORING.items():
        published, runs = published_ratio(study, filter_)
        ours, error = ratio_to_mapf(results, study, filter_)
        trials = results.in_shards(study, POINT, filter_).trials
        allowed = results.tolerance * error * np.sqrt(1 + trials / runs)
        comparison = f"{words}: {ours:.3f} ± {error:.3f}, published {published}: distance"
        parts.append(below(comparison, abs(ours - published), float(allowed), error))
    return parts


@claim(
    CLAIMS,
    "nc-to-mapf-ratio",
    "Tables I-II: ignoring the coupling raises the average RMSE by the published factors.",
)
def nc_to_mapf_ratio(results: Results) -> list[Part]:
    return ratios_as_published(results, "mapf_nc")


@claim(
    CLAIMS,
    "nmc-to-mapf-ratio",
    "Tables I-II: ignoring the censoring raises the average RMSE by the published factors.",
)
def nmc_to_mapf_ratio(results: Results) -> list[Part]:
    return ratios_as_published(results, "mapf_nmc")


@claim(
    CLAIMS,
    "saturation-costlier-than-dead-band",
    "Tables I-II: ignoring saturation costs far more than ignoring the dead band.",
)
def saturation_costlier_than_dead_band(results: Results) -> list[Part]:
    factor = results.analysis("saturation").far_costlier
    (dead_band, a), (saturation, b) = (
        ratio_to_mapf(results, study, "mapf_nmc") for study in ("deadband", "saturation")
    )
    comparison = f"NMC/MAPF: {factor:g} times that of the dead band - that of saturation"
    return [Part(comparison, factor * dead_band - saturation, independent_error(factor * a, b))]


@claim(
    CLAIMS,
    "mpf-close-to-mapf",
    "Tables I-II: the average RMSE of MPF is close to that of MAPF.",
)
def mpf_close_to_mapf(results: Results) -> list[Part]:
    parts = []
    for study, words in CENSORING.items():
        ours, error = ratio_to_mapf(results, study, "mpf")
        published, _ = published_ratio(study, "mpf")
        name = f"{words}: logarithm of MPF/MAPF, {ours:.3f}, published {published}"
        margin = np.log(results.analysis(study).close_ratio)
        parts += equivalent(name, float(np.log(ours)), error / ours, float(margin))
    return parts
