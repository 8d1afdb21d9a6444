"""Model of ``drycut.ballbar/1`` (docs/ballbar.md)."""

from typing import Annotated, Final, Literal, TypedDict

from parser.documents import (
    AxisName,
    Document,
    Judgement,
    Law,
    Point,
    Positive,
    Sense,
    Size,
    Text,
    Version,
    between,
    of_length,
    one_of,
)


class SenseEntry(TypedDict):
    """Figures of one turn."""

    circularity_um: Size
    radial_max_um: float
    radial_min_um: float
    mean_radius_um: float


class FiguresEntry(TypedDict):
    """Figures of both turns together."""

    mean_radial_um: float
    hysteresis_um: Size
    center_um: Point
    ccw: SenseEntry
    cw: SenseEntry


class ReversalEntry(TypedDict):
    """What an axis does where it turns back."""

    direction: Sense
    axis: AxisName
    side: Annotated[str, one_of("+", "-")]
    step_um: float
    spike_um: Size
    spike_deg: Annotated[float, between(0, 360)] | None


class PartsEntry(TypedDict):
    """The deviation, split into what causes it."""

    radius_ccw_um: float
    radius_cw_um: float
    step_x_um: float
    step_y_um: float
    diameters_um: float
    lag_um: float
    interpolation_um: Size
    rest_um: Size
    reversals: Annotated[list[ReversalEntry], of_length(8, 8)]


class LossEntry(TypedDict):
    """What a drive lost in a turn."""

    direction: Sense
    kind: Annotated[str, one_of("lost-steps", "trip")]
    axis: AxisName
    t_s: Size
    amount_um: float
    x_um: float
    y_um: float


class BallbarDocument(TypedDict):
    """A circular test, ``ballbar.json``."""

    schema: Literal["drycut.ballbar/1"]
    drycut: Version
    verdict: Judgement
    machine: Text
    interpolator: Annotated[str, one_of("point-by-point", "card")]
    radius_um: Annotated[int, between(100, None)]
    feed_um_s: Positive
    planned_feed_um_s: Positive
    tolerance_um: Positive | None
    circularity_um: Size | None
    figures: FiguresEntry | None
    parts: PartsEntry | None
    losses: list[LossEntry]


BALLBAR: Final = Document(
    BallbarDocument,
    "docs/ballbar.md",
    (
        Law(BallbarDocument, "verdict", Literal["pass"], {"losses": {"maxItems": 0}, "circularity_um": float}),
        Law(
            BallbarDocument,
            "circularity_um",
            None,
            {"figures": None, "parts": None},
            {"figures": FiguresEntry, "parts": PartsEntry},
        ),
    ),
)
