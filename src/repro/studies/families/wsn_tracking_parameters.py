"""Parameters of the tracking study in a wireless sensor network [packet_delays Sec. 4.2]."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from repro.parameters.values import (
    Covariance5,
    NotNegative,
    Pair,
    PointParameters,
    Positive,
    Probability,
    Row5,
    Values,
)


class Parameters(PointParameters):
    """Values of one point. A state is (px, py, vx, vy, omega) in m, m, m/s, m/s, rad/s."""

    field_side: Annotated[Positive, Field(description="m, side of the square field")]
    sensors: Annotated[int, Field(ge=1, description="number of sensors in the field")]
    layout: Annotated[
        Literal["redrawn", "fixed"],
        Field(description="sensor positions: drawn in every trial, or `fixed_layout` in all"),
    ]
    fixed_layout: Annotated[
        tuple[tuple[Probability, Probability], ...],
        Field(min_length=1, description="x and y of each sensor as shares of the field's side"),
    ]
    sampling_time: Annotated[
        Positive | Literal["k"],
        Field(description="s, T of the turn angle T omega(k); `k` takes the printed k omega(k)"),
    ]
    initial_estimate: Annotated[Row5, Field(description="xh(0|0); m, m/s, rad/s")]
    initial_covariance: Annotated[Covariance5, Field(description="P(0|0); m, m/s, rad/s, squared")]
    true_initial_state: Annotated[
        Literal["estimate", "drawn"],
        Field(description="x(0): equal to xh(0|0), or drawn from N(xh(0|0), P(0|0))"),
    ]
    true_turn_rate_variance: Annotated[
        NotNegative, Field(description="(rad/s)^2 per step, process noise of the true turn rate")
    ]
    turn_rate_variance: Annotated[
        NotNegative,
        Field(description="(rad/s)^2 per step, process noise q that the filters assume"),
    ]
    measurement_variance: Annotated[Positive, Field(description="m^2, variance R of a range")]
    channel: Annotated[
        Literal["lossy", "eq2"],
        Field(description="packets later than N are lost, or by (2) the one of k - N always comes"),
    ]
    packet_bound: Annotated[int, Field(ge=0, description="steps, largest delay N of a packet")]
    arrival_probability: Annotated[
        Probability, Field(description="probability p that a transmission succeeds")
    ]
    scheduled_on: Annotated[
        Literal["predicted estimate", "true position"],
        Field(description="position to which the sensor that measures is the nearest"),
    ]

    @model_validator(mode="after")
    def _fixed_layout_has_every_sensor(self) -> Self:
        if self.layout == "fixed" and len(self.fixed_layout) != self.sensors:
            raise ValueError(
                f"fixed_layout has {len(self.fixed_layout)} positions; "
                f"sensors asks for {self.sensors}"
            )
        return self


class Analysis(Values):
    """Thresholds of the table and the claims, and what the text says of the figures."""

    lost_above: Annotated[Positive, Field(description="m, largest error of a run that tracks")]
    small_error: Annotated[
        Positive, Field(description="m, bound of the errors without losses, Fig. 4")
    ]
    equal_within: Annotated[
        Positive, Field(description="difference of equal estimates, relative to the errors")
    ]
    much_higher: Annotated[
        float, Field(gt=1, description="factor by which an error that is much higher is above")
    ]
    figure_6_missed_step: Annotated[
        int, Field(ge=1, description="step k at which Fig. 6 has its missed packet")
    ]
    figure_10_missed_packets: Annotated[
        int, Field(ge=0, description="number of missed packets of the run in Fig. 10")
    ]
    figure_10_largest_errors: Annotated[
        dict[int, Pair],
        Field(description="m, largest error in Fig. 10 as a range, lowest and highest, by N"),
    ]
    typical_quantiles: Annotated[
        tuple[Probability, Probability],
        Field(description="quantiles of the runs between which a single run is typical"),
    ]
