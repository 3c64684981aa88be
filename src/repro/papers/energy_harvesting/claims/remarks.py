"""Claims that need no run: the entries of S(k) and the density of both noises [energy_harvesting
Remarks 3 and 4]."""

import numpy as np

from repro.filters.families import ross_eh
from repro.kernels import sensor_network_step as kernels
from repro.network.energy_harvesting import lemma_1_matrix
from repro.papers.energy_harvesting.compared import SWEPT_STUDY, study_of
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim

CLAIMS: list[Claim] = []
POINTS = 4001  # of the quadrature
REACH = 10.0  # means of an exponential density, standard deviations of a Gaussian one
ERRORS = 41  # at which the densities are compared


@claim(
    CLAIMS,
    "remark-3-count-of-entries",
    "Remark 3: If Hbar < Ebar, the first Ebar - Hbar + 1 elements of the last row of S(k) are -1.",
)
def entries_of_the_last_row(results: Results) -> list[Part]:
    capacity = results.parameters(SWEPT_STUDY, "base").energy_capacity
    rounding, parts = results.analysis(SWEPT_STUDY).rounding, []
    for most_harvested in range(capacity):
        law = np.zeros(capacity)
        law[: most_harvested + 1] = 1 / (most_harvested + 1)
        last = lemma_1_matrix(law, capacity)[-1]
        others = np.flatnonzero(np.abs(last + 1) > rounding)
        leading = others[0] if len(others) else len(last)
        name = f"Ebar = {capacity}, Hbar = {most_harvested}: other than stated"
        parts.append(below(name, abs(leading - (capacity - most_harvested + 1)), 0.5))
    return parts


@claim(
    CLAIMS,
    "likelihood-convolves-both-noises",
    "Remark 4: The density of nu + n in the likelihood is the convolution (28) of theirs.",
)
def densities_are_convolved(results: Results) -> list[Part]:
    parts = []
    for study, of_study in (("ungm", of_exponentials), ("rss_2d", of_gaussians)):
        noises = ross_eh.noises(study_of(study).model(results.parameters(study, "base")))
        ours, wanted = of_study(noises[0], noises[-1])
        name = f"{study}: largest difference of the densities"
        rounding = results.analysis(study).rounding
        parts.append(below(name, np.abs(np.exp(ours) - wanted).max(), rounding))
    return parts


def of_exponentials(mean: float, _: float) -> tuple[np.ndarray, np.ndarray]:
    """Logarithm of the filters' density of nu + n, and (28) by quadrature, (ERRORS,) each."""

    def density(x: np.ndarray) -> np.ndarray:
        return np.exp(-x / mean) / mean

    errors, ours = np.linspace(0.0, REACH * mean, ERRORS)[1:], np.zeros(ERRORS - 1)
    kernels.exponential_log_likelihood(-errors, 0.0, mean, ross_eh.network(1.0, None), ours)
    nu = np.linspace(0.0, errors, POINTS)  # both densities are zero beyond
    return ours, np.trapezoid(density(nu) * density(errors - nu), nu, axis=0)


def of_gaussians(variance: float, channel: float) -> tuple[np.ndarray, np.ndarray]:
    """As `of_exponentials`."""

    def density(x: np.ndarray, of: float) -> np.ndarray:
        return np.exp(-0.5 * x**2 / of) / np.sqrt(2 * np.pi * of)

    errors = np.linspace(-1.0, 1.0, ERRORS) * REACH * np.sqrt(variance)
    ours, network = np.zeros(ERRORS), ross_eh.network(1.0, None)
    kernels.gaussian_log_likelihood(-errors, 0.0, variance + channel, channel, network, ours)
    n = np.linspace(-1.0, 1.0, POINTS)[:, None] * REACH * np.sqrt(channel)
    return ours, np.trapezoid(density(errors - n, variance) * density(n, channel), n, axis=0)
