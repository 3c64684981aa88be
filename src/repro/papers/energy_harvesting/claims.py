"""Claims of Song et al. (Figures 2-13 and their text), and of its Lemma 1 and Remarks 3 and 5.

An accuracy is compared by the mean over k of RMSE(k), of all runs and of those that neither filter
loses, and by the share of runs in which the one errs less: a few lost runs can set the first.
"""

from itertools import pairwise

import numpy as np

from repro import plugins
from repro.network import energy_harvesting
from repro.run import run
from repro.simulate import simulated
from repro.statistics import metrics
from repro.statistics.shards import Columns
from repro.studies.families import harvesting_sensors, signal_strength
from repro.tables.results import Results
from repro.verdicts.claims import Claim, Part, below, claim, most, smaller

CLAIMS: list[Claim] = []
OTHERS = ("pf_ross", "pf_eh", "spf")  # what PF-ROSS-EH is compared with on the same data
FIVE = ("pf_ross_eh", *OTHERS, "spf_im")
FEW = 10  # runs, too few for a comparison
SHOWN = 3  # Figs. 4 and 5 show sensor 4


def squared(results: Results, study: str, point: str, filter_: str, component: str) -> Columns:
    """Squared errors of every run at k = 1 ... K."""
    axes = plugins.study(study).components[component]
    return results.each(
        study, point, filter_, lambda runs: harvesting_sensors.squared(runs, axes)[:, 1:]
    )


def lost(results: Results, study: str, *runs: tuple[str, str]) -> np.ndarray:
    """Which trials one of the (point, filter) has lost, (trials,)."""
    return np.any([results.each(study, *at, plugins.study(study).lost) for at in runs], axis=0)


def combination(what: str, weights: tuple[float, ...], errors: list[Columns]) -> Part:
    """The weighted sum of mean RMSEs is negative; jackknife over the trials that they share."""
    runs = errors[0].trials
    if runs < 2:
        return Part(f"{what}: {runs} runs", np.nan, np.nan)
    numbers = [metrics.roots_over_steps(error) for error in errors]
    return Part(
        f"{what} ({', '.join(f'{number.value:.3g}' for number in numbers)}; {runs} runs)",
        float(np.dot(weights, [number.value for number in numbers])),
        float(metrics.jackknife_error(np.dot(weights, [number.left_out for number in numbers]))),
    )


def better(results, study, first, second, component, what) -> list[Part]:
    """(point, filter) `first` is more accurate: over all runs, in most, and over those not lost."""
    errors = [squared(results, study, *at, component) for at in (first, second)]
    parts = [
        combination(f"{what}, all runs", (1, -1), errors),
        most(f"{what}, run by run", np.less(*(error.mean_over_steps() for error in errors))),
    ]
    if study == "ungm":
        return parts
    kept = ~lost(results, study, first, second)
    if kept.sum() < FEW:  # of those not lost nothing can be said: who loses them, then?
        losses = (lost(results, study, at).astype(float) for at in (first, second))
        return [*parts, smaller(f"{what}, share of runs lost", *losses)]
    what = f"{what}, runs not lost"
    return [*parts, combination(what, (1, -1), [error.only(kept) for error in errors])]


def best_of(results, study: str, first: str, others, components) -> list[Part]:
    """`first` is more accurate than each of the others in every component."""
    return [
        part
        for component in components
        for other in others
        for part in better(
            results,
            study,
            ("base", first),
            ("base", other),
            component,
            f"{study} {component}: {first} - {other}",
        )
    ]


def ordered(results, study: str, points: list[str], names: list[str]) -> list[Part]:
    """PF-ROSS-EH is more accurate at each point than at the next, in position and velocity."""
    return [
        part
        for component in plugins.study(study).components
        for (low, high), (first, second) in zip(pairwise(points), pairwise(names), strict=True)
        for part in better(
            results,
            study,
            (low, "pf_ross_eh"),
            (high, "pf_ross_eh"),
            component,
            f"{component}: {first} - {second}",
        )
    ]


@claim(CLAIMS, "A-C1", "Fig. 2: in the scalar example PF-ROSS-EH is more accurate than SPF")
def scalar_example(results):
    return best_of(results, "ungm", "pf_ross_eh", ["spf"], ["state"])


@claim(
    CLAIMS, "A-C2 2-D", "Figs. 6-7: PF-ROSS-EH is more accurate than PF-ROSS, PF-EH and SPF in 2-D"
)
def best_in_the_plane(results):
    return best_of(results, "rss_2d", "pf_ross_eh", OTHERS, ("position", "velocity"))


@claim(
    CLAIMS, "A-C2 3-D", "Figs. 12-13: PF-ROSS-EH is more accurate than PF-ROSS, PF-EH, SPF in 3-D"
)
def best_in_space(results):
    return best_of(results, "rss_3d", "pf_ross_eh", OTHERS, ("position", "velocity"))


@claim(CLAIMS, "A-C3 best", "Figs. 6-7: SPF-IM, which sees unimpaired data, is the best")
def ideal_is_best(results):
    return best_of(results, "rss_2d", "spf_im", FIVE[:-1], ("position", "velocity"))


@claim(
    CLAIMS,
    "A-C3 near",
    "Figs. 6-7: PF-ROSS-EH comes near SPF-IM: nearer than to any of PF-ROSS, PF-EH, SPF",
)
def approaches_ideal(results):
    parts = []
    for component in ("position", "velocity"):
        for other in OTHERS:
            three = ("pf_ross_eh", "spf_im", other)
            errors = [squared(results, "rss_2d", "base", f, component) for f in three]
            kept = ~lost(results, "rss_2d", *(("base", f) for f in three))
            name = f"{component}: 2 pf_ross_eh - spf_im - {other}"
            parts.append(combination(f"{name}, all runs", (2, -1, -1), errors))
            errors = [error.only(kept) for error in errors]
            parts.append(combination(f"{name}, runs not lost", (2, -1, -1), errors))
    return parts


@claim(CLAIMS, "A-C4", "Fig. 8: the error rises with the probability of saturation, 0.2, 0.5, 0.8")
def saturation_hurts(results):
    points = ["base", "gamma=0.5", "gamma=0.8"]
    return ordered(results, "rss_2d", points, ["0.2", "0.5", "0.8"])


@claim(CLAIMS, "A-C5", "Fig. 9: the error falls with the number of sensors, 2, 4, 6")
def sensors_help(results):
    points = ["sensors=6", "base", "sensors=2"]
    return ordered(results, "rss_2d", points, ["N=6", "N=4", "N=2"])


@claim(CLAIMS, "A-C6", "Fig. 10: the error is smaller under Pi_1 than under Pi_2")
def harvest_helps(results):
    return ordered(results, "rss_2d", ["base", "harvest=pi_2"], ["Pi_1", "Pi_2"])


def transmission(results: Results, study: str, point: str, rule: str) -> np.ndarray:
    """lambda(k) for k = 1 ... K."""
    parameters = results.parameters(study, point)
    queue = harvesting_sensors.queue(parameters)
    return energy_harvesting.transmission_probability(queue, parameters.steps, rule)[1:]


def sent(results: Results, study: str, point: str) -> np.ndarray:
    """Share of the sensors that transmit, (trials, K)."""
    return results.each_log(
        study, point, lambda log: harvesting_sensors.sent(log)[:, 1:].mean(axis=2)
    )


@claim(CLAIMS, "A-C6 cause", "Sec. IV-B: under Pi_2 a sensor transmits less often at every k")
def harvest_is_the_cause(results):
    first, second = (transmission(results, "rss_2d", p, "exact") for p in ("base", "harvest=pi_2"))
    shares = [sent(results, "rss_2d", p).mean(axis=1) for p in ("harvest=pi_2", "base")]
    return [
        below("least favourable k: exact probability under Pi_2 - Pi_1", (second - first).max(), 0),
        smaller("share of transmissions in the logs: Pi_2 - Pi_1", *shares),
    ]


@claim(CLAIMS, "A-C7", "Fig. 4: in the shown run the output of sensor 4 is saturated at times")
def saturation_is_seen(results):
    instants = results.each_log(
        "rss_2d", "base", lambda log: signal_strength.saturated(log, SHOWN)[:, 1:].sum(axis=1)
    )
    return [
        below("minus the number of such instants in run 0", -instants[0], -0.5),
        most("a run has one", instants > 0),
    ]


@claim(CLAIMS, "A-C8", "Fig. 5: E starts at 1, stays in 0 ... 3, obeys (6); sent exactly if E > 0")
def battery_obeys(results):
    wrong = results.each_log("rss_2d", "base", broken_rules).sum()
    return [below("entries of all logs that break a rule", wrong, 0.5)]


def broken_rules(log) -> np.ndarray:
    """Number of entries of each run that break a rule of the battery, (trials,)."""
    queue = harvesting_sensors.queue(log.parameters)
    wrong = np.zeros(len(log.trials))
    for i in range(1, log.parameters.sensors + 1):
        energy, harvest, transmits = (
            log.field("/network", f"{name}_{i}") for name in ("energy", "harvest", "sent")
        )
        spent = energy[:, :-1] - transmits[:, :-1]
        wrong += (energy[:, 0] != 1) + ((energy < 0) | (energy > 3)).sum(axis=1)
        wrong += ((energy > 0) != (transmits == 1)).sum(axis=1)
        kept = np.minimum(spent + harvest[:, 1:], queue.capacity)
        wrong += (energy[:, 1:] != kept).sum(axis=1)
    return wrong


@claim(CLAIMS, "A-C9 2-D", "Sec. IV-B expects: ignoring both effects is worst in 2-D")
def ignoring_is_worst_in_the_plane(results):
    return ignoring_is_worst(results, "rss_2d", ("position", "velocity"))


@claim(CLAIMS, "A-C9 3-D", "Sec. IV-B expects: ignoring both effects is worst in 3-D")
def ignoring_is_worst_in_space(results):
    return ignoring_is_worst(results, "rss_3d", ("position", "velocity"))


@claim(CLAIMS, "A-C9 scalar", "Sec. IV-B's expectation in the scalar example: SPF is the worst")
def ignoring_is_worst_in_one_dimension(results):
    return ignoring_is_worst(results, "ungm", ("state",))


def ignoring_is_worst(results, study: str, components) -> list[Part]:
    """SPF is the last of the five, in the mean and run by run."""
    return [
        part
        for component in components
        for other in FIVE
        if other != "spf"
        for part in better(
            results,
            study,
            ("base", other),
            ("base", "spf"),
            component,
            f"{component}: {other} - spf",
        )[:2]
    ]


@claim(CLAIMS, "A-C10 energy", "Remark 5: with gbar = 0 PF-ROSS-EH is the filter with energy only")
def reduces_to_energy_only(results):
    return equal_estimates(results, "pf_eh", saturation_probability=0.0)


@claim(
    CLAIMS, "A-C10 saturation", "Remark 5: with lambda = 1 PF-ROSS-EH is the filter of saturation"
)
def reduces_to_saturation_only(results):
    return equal_estimates(
        results, "pf_ross", harvest_transition=[[0, 1, 0, 0]] * 4, initial_harvest="full"
    )


def equal_estimates(results, other: str, **changes) -> list[Part]:
    """PF-ROSS-EH and the other filter agree where the parameters are so changed."""
    parts = []
    for study in ("ungm", "rss_2d"):
        log = results.log(study, "base")
        parameters = log.parameters | changes
        changed = simulated(study, "base", parameters, log.seed, log.trials[:4])
        settings = {"particles": 200, "resampling": "systematic", "weights": "logarithmic"}
        first, second = (run(changed, name, settings)[0] for name in ("pf_ross_eh", other))
        parts.append(below(f"{study}: largest difference", np.abs(first - second).max(), 1e-12))
    return parts


@claim(CLAIMS, "A-D1", "Lemma 1: its lambda is the probability that a sensor transmits")
def lemma_1_is_right(results):
    parts = []
    for study, point in (("rss_2d", "base"), ("rss_2d", "harvest=pi_2")):
        lemma, exact = (transmission(results, study, point, rule) for rule in ("lemma1", "exact"))
        name = f"{study} {point}"
        parts.append(below(f"{name}: largest error", np.abs(lemma - exact).max(), 1e-12))
        share = sent(results, study, point)
        apart = (share - lemma).mean(axis=1)  # over k, of each trial
        error = metrics.mean_error(apart)
        parts.append(
            Part(f"{name}: |logs - Lemma 1| - 3 errors", float(abs(apart.mean()) - 3 * error), 0.0)
        )
    return parts


@claim(
    CLAIMS, "A-D2", "Remark 3: an identity matrix is a case in which Lemma 1 is exact as in [50]"
)
def identity_is_the_reduction(results):
    lemma, exact = (
        transmission(results, "ungm", "reading-harvest=identity", rule)
        for rule in ("lemma1", "exact")
    )
    return [below("largest error of Lemma 1 for Pi = I", np.abs(lemma - exact).max(), 1e-12)]
