"""Parameters of the studies with three coupled targets [censored_network Sec. IV]."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from repro.parameters.values import (
    NotNegative,
    Pair,
    PointParameters,
    Positive,
    Probability,
    Rectangular,
    Triple,
    Values,
)

Deviations = tuple[NotNegative, NotNegative, NotNegative]


class Parameters(PointParameters):
    """Values of one point [censored_network (1)-(7), (23)-(25)]."""

    initial_states: tuple[Triple, Triple, Triple] = Field(
        description="m, m, rad; true state of each target at k = 0, and the prior mean"
    )
    initial_deviation: Deviations = Field(description="m, m, rad; standard deviation of the prior")
    speed: Triple = Field(description="m per step, v of each target")
    turn_rate: float = Field(description="rad per step, Omega")
    process_deviation: Deviations = Field(
        description="m, m, rad; standard deviation of the process noise"
    )
    coupling_strength: NotNegative = Field(
        description="m or rad as the state, c^ij between two targets"
    )
    self_coupling_strength: NotNegative = Field(
        description="m or rad as the state, c^ii of a target on itself"
    )
    coupling_rate: Probability = Field(
        description="1, alphabar: probability that a target is coupled"
    )
    sensor_groups: Annotated[
        tuple[Annotated[tuple[Pair, ...], Field(min_length=1)], ...],
        Field(min_length=1, description="m, position of each sensor of each group"),
        Rectangular,
    ]
    group_probabilities: tuple[Probability, ...] = Field(
        min_length=1, description="1, p_m: probability that group m transmits"
    )
    group_known: bool = Field(description="whether the filters are told which group transmits")
    strength_at_reference: float = Field(
        description="dB, Phi_0: signal strength at the reference distance"
    )
    path_loss_exponent: float = Field(gt=0, le=10, description="1, eta")
    reference_distance: float = Field(ge=0.001, description="m, r_0")
    glint_probability: Probability = Field(
        description="1, kappa: weight of the wide noise component"
    )
    nominal_deviation: Positive = Field(
        description="dB, sigma_1: standard deviation of the narrow component"
    )
    glint_deviation: Positive = Field(
        description="dB, sigma_2: standard deviation of the wide component"
    )
    censoring: Literal["dead band", "saturation"] = Field(description="censoring model, (4) or (5)")
    lower_threshold: float = Field(description="dB, y_l")
    upper_threshold: float = Field(description="dB, y_r")
    dead_band_constant: float = Field(
        description="dB, y_const: what arrives of a reading inside the dead band"
    )

    @model_validator(mode="after")
    def _every_group_has_a_probability(self) -> Self:
        if len(self.group_probabilities) != len(self.sensor_groups):
            raise ValueError(
                "group_probabilities and sensor_groups must be of one length; "
                f"they have {len(self.group_probabilities)} and {len(self.sensor_groups)} entries"
            )
        return self


class Analysis(Values):
    """Thresholds of the metrics and of the claims."""

    lost_above: Positive = Field(description="m, position error above which a target is lost")
    short_horizon: int = Field(
        ge=1, description="steps over which the RMSE is averaged besides all"
    )
    far_costlier: Positive = Field(description="1, factor by which one cost must exceed another")
    close_ratio: float = Field(gt=1, description="1, ratio up to which two RMSE are close")
    rate_margin: Positive = Field(
        description="1, distance from its exponent up to which a rate of convergence is the stated"
    )
    identity_trials: int = Field(ge=1, description="trials on which an identity is tested")
    identity_steps: int = Field(ge=1, description="steps over which it is tested")
    identity_particles: int = Field(ge=2, description="particles per node with which it is tested")
    identity_tolerance: Positive = Field(description="largest difference by which it still holds")
