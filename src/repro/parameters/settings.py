"""What the papers' filters can be set to. A filter that is not listed here has a `Settings` of its
own, or takes its settings as they are given."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal

from pydantic import Field

from repro.parameters.values import ParameterError, Probability, Values

Particles = Annotated[int, Field(ge=1, description="number of particles of a trial")]
Resampling = Annotated[
    Literal["systematic", "multinomial"], Field(description="scheme of resampling")
]


class MinimumVariance(Values):
    """OMVF [packet_delays Theorem 1]."""

    alpha_rule: Annotated[
        Literal["sum to one", "8b"],
        Field(description="mean weights by (8b) and (8c), or by (8b) alone"),
    ] = "sum to one"
    qbar_sign: Annotated[Literal[1, -1], Field(description="sign of Qbar")] = 1


class ExtendedMinimumVariance(MinimumVariance):
    """EMVF [packet_delays Theorem 2]."""

    initial_second_moment: Annotated[
        Literal["theorem_2", "P0", "matched"],
        Field(description="S(0), second moment of the initial state"),
    ] = "theorem_2"
    late_measurement: Annotated[
        Literal["own sensor", "current sensor"],
        Field(description="sensor whose range a late packet holds"),
    ] = "own sensor"


class RealisedIndicators(ExtendedMinimumVariance):
    """EMVF on the arrivals that happened [packet_delays (22)]."""

    indicator_of: Annotated[
        Literal["k", "k+1"], Field(description="step whose arrivals are the indicators of (22)")
    ] = "k"


class ProtocolParticles(Values):
    """MAPF and its variants [censored_network Algorithm 1]."""

    particles: Annotated[int, Field(ge=2, description="number of particles of a node")] = 1000
    resampling: Resampling = "systematic"
    coupling_drawn_per: Annotated[
        Literal["particle", "step"], Field(description="what shares a draw of the coupling")
    ] = "particle"


class JointBootstrap(Values):
    """PF-ROSS-EH on the joint chain of energy and harvest."""

    particles: Particles = 500
    resampling: Resampling = "systematic"


class Bootstrap(JointBootstrap):
    """PF-ROSS-EH and the filters it is compared with [energy_harvesting Algorithm 1]."""

    weights: Annotated[
        Literal["logarithmic", "linear"], Field(description="scale in which weights are multiplied")
    ] = "logarithmic"


class MergedHypotheses(Values):
    """BKF-II [unknown_losses Algorithm 2]."""

    prior: Annotated[
        Literal["theta", "lambda(k-1)"],
        Field(description="prior of gamma(k): of the loss process, or lambda(k-1)"),
    ] = "theta"


class RaoBlackwell(Values):
    """RBPF and Fast RBPF [unknown_losses Algorithms 3 and 4]."""

    particles: Particles = 200
    threshold: Annotated[Probability, Field(description="N_T as a share of the particles")] = 0.5
    resampling: Resampling = "multinomial"
    proposal: Annotated[
        Literal["prior", "optimal"],
        Field(description="law that gamma(k) of a particle is drawn from"),
    ] = "prior"
    covariance: Annotated[
        Literal["with spread", "printed"],
        Field(description="of the mixture, or as printed in (17)"),
    ] = "with spread"


class SampledStates(Values):
    """The standard particle filter beside the RBPF: its particles are states."""

    particles: Particles = 200
    resampling: Resampling = "multinomial"


SETTINGS: dict[str, type[Values]] = {
    "omvf": MinimumVariance,
    "emvf": ExtendedMinimumVariance,
    "emvf_realised": RealisedIndicators,
    **dict.fromkeys(("mapf", "mapf_nc", "mapf_nmc", "mpf", "dead_reckoning"), ProtocolParticles),
    **dict.fromkeys(
        ("pf_ross_eh", "pf_ross", "pf_eh", "spf", "spf_im", "pf_ross_eh_exact"), Bootstrap
    ),
    "pf_ross_eh_joint": JointBootstrap,
    "bkf_2": MergedHypotheses,
    "rbpf": RaoBlackwell,
    "rbpf_fast": RaoBlackwell,
    "sir_losses": SampledStates,
}


ASSUMED = "assumed_"  # begins a setting that any filter may have, and so a wrong model


def assumed_parameters(settings: Mapping[str, Any]) -> dict[str, Any]:
    """The parameters of the point that the filter takes for others: `assumed_<parameter>`."""
    return {
        name.removeprefix(ASSUMED): value
        for name, value in settings.items()
        if name.startswith(ASSUMED)
    }


def own_settings(settings: Mapping[str, Any]) -> dict[str, Any]:
    """The settings that the filter itself knows."""
    return {name: value for name, value in settings.items() if not name.startswith(ASSUMED)}


def checked_settings(filter_: str, values: Mapping[str, Any], where: str) -> dict[str, Any]:
    """The settings as JSON has them; checked, if the filter is one of the papers'."""
    if filter_ not in SETTINGS:
        return dict(values)
    assumed = {name: value for name, value in values.items() if name.startswith(ASSUMED)}
    return SETTINGS[filter_].checked(own_settings(values), where).plain() | assumed


class PlainSettings(dict[str, Any]):
    """Settings of a filter that declares no type for them.

    Reading a key that was not given raises ParameterError; `check_all_read` refuses keys that the
    filter has not read. `get` and `in` read a key; iterating reads all of them.
    """

    def __init__(self, values: Mapping[str, Any], where: str):
        """`where` begins the messages: the filter and where it runs."""
        super().__init__(values)
        self._where, self._unread = where, set(values)

    def __getitem__(self, key: str) -> Any:
        self._unread.discard(key)
        if not super().__contains__(key):
            raise ParameterError(
                f"{self._where}: the setting '{key}' is missing; give it in its rule: "
                f"params: settings=dict({key}=...)"
            )
        return super().__getitem__(key)

    def __contains__(self, key: object) -> bool:
        self._unread.discard(str(key))
        return super().__contains__(key)

    def get(self, key: str, default: Any = None) -> Any:
        """The value, or the default if it is not given."""
        self._unread.discard(key)
        return super().get(key, default)

    # A filter that takes all settings at once, as in Parameters(**settings), reads each of them.
    def __iter__(self) -> Iterator[str]:
        self._unread.clear()
        return super().__iter__()

    def keys(self) -> Any:
        """All keys."""
        self._unread.clear()
        return super().keys()

    def values(self) -> Any:
        """All values."""
        self._unread.clear()
        return super().values()

    def items(self) -> Any:
        """All keys with their values."""
        self._unread.clear()
        return super().items()

    def check_all_read(self) -> None:
        """Raise ParameterError if a setting was given that the filter has not read."""
        if self._unread:
            names = ", ".join(f"'{key}'" for key in sorted(self._unread))
            kind = "setting" if len(self._unread) == 1 else "settings"
            verb = "is" if len(self._unread) == 1 else "are"
            raise ParameterError(
                f"{self._where}: the {kind} {names} {verb} never used; "
                "fix the name, or leave it out of the rule"
            )


def typed_settings(module: Any, filter_: str, values: Mapping[str, Any], where: str) -> Any:
    """The settings as `build` gets them: typed by SETTINGS, by the module's own `Settings`, or not.

    Raises ParameterError if the values do not fit; `where` begins its message.
    """
    model = SETTINGS.get(filter_) or getattr(module, "Settings", None)
    return PlainSettings(values, where) if model is None else model.checked(values, where)
