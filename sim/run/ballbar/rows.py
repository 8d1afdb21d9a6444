"""The test in rows for people: names and values, the same on the terminal and in the picture."""

from typing import Final, NamedTuple

from parser.toolpath import Axis
from parser.units import mm
from sim.run.ballbar.circle import Ballbar
from sim.run.ballbar.figures import Figures
from sim.run.ballbar.parts import DeviationParts
from sim.run.ballbar.turn import NAMES, Sense
from sim.table.record.losses import Loss

FIGURES: Final = "figures, µm"
PARTS: Final = "parts, µm"
INTERPOLATORS: Final = {"point-by-point": "point by point", "card": "by the card at equal times"}


class Row(NamedTuple):
    """A name and its value, as text."""

    name: str
    value: str


def setup_rows(ballbar: Ballbar) -> list[Row]:
    """What was run."""
    test = ballbar.test
    controller = test.machine.controller
    return [
        Row("machine", test.machine.name),
        Row("radius", radius_text(ballbar)),
        Row("feed", feed_text(ballbar)),
        Row(
            "  of the machine", f"cuts {_mm_min(controller.cut_step_limit_hz)} at most, jumps {_jumps(ballbar)} mm/min"
        ),
        Row("steps of 1 µm", INTERPOLATORS[controller.interpolation]),
    ]


def figure_rows(figures: Figures) -> list[Row]:
    """The figures of ISO 230-4, µm."""
    ccw, cw = figures.ccw, figures.cw
    return [
        Row("circularity G(b), both", number_text(figures.circularity_um)),
        Row("circularity G", _ways(ccw.circularity_um, cw.circularity_um)),
        Row("radial deviation F, max", _ways(ccw.radial_max_um, cw.radial_max_um)),
        Row("radial deviation F, min", _ways(ccw.radial_min_um, cw.radial_min_um)),
        Row("mean radial deviation D", number_text(figures.mean_radial_um)),
        Row("hysteresis H", number_text(figures.hysteresis_um)),
    ]


def part_rows(parts: DeviationParts, interpolation_um: float) -> list[Row]:
    """What the deviation consists of, µm."""
    return [
        Row("backlash: reversal step", _axes(*parts.step_um)),
        Row("highest reversal spike", _axes(parts.spike_um(Axis.X), parts.spike_um(Axis.Y))),
        Row("radius change", _ways(*parts.radius_um)),
        Row("diameter, X less Y", number_text(parts.diameters_um)),
        Row("way X lags behind Y", number_text(parts.lag_um)),
        Row("interpolation, G of it", number_text(interpolation_um)),
        Row("rest, largest", number_text(parts.rest_um)),
    ]


def loss_text(sense: Sense, loss: Loss) -> str:
    """A loss in words."""
    axis = Axis(loss.axis).name
    what = (
        f"the {axis} stepper lost {loss.amount_um:+,.0f} µm"
        if loss.kind == "lost-steps"
        else f"the {axis} servo tripped on a following error of {loss.amount_um:+,.1f} µm"
    )
    text = f"{NAMES[sense]}: {what} at {loss.t_s:.3f} s, {mm(loss.x_um):.3f}, {mm(loss.y_um):.3f} mm from the start"
    return text.replace("-", "−")


def radius_text(ballbar: Ballbar) -> str:
    """The nominal radius."""
    return f"{mm(float(ballbar.test.radius_um)):g} mm"


def feed_text(ballbar: Ballbar) -> str:
    """The feed, and what the plan made of it where that is less."""
    asked, run = ballbar.test.feed_um_s, ballbar.run_um_s
    planned = f", planned at {_mm_min(run)}: the acceleration of the machine bends no faster"
    return f"{_mm_min(asked)} mm/min" + planned * (run < asked * (1.0 - 1e-6))


def um(value: float) -> str:
    """A length in µm."""
    return f"{number_text(value)} µm"


def _ways(ccw: float, cw: float) -> str:
    return f"ccw {number_text(ccw)}, cw {number_text(cw)}"


def _axes(x: float, y: float) -> str:
    return f"X {number_text(x)}, Y {number_text(y)}"


def number_text(value: float) -> str:
    """Two decimals, fewer of what is larger than 100, never −0."""
    decimals = 2 if abs(value) < 100.0 else 1 if abs(value) < 1000.0 else 0
    return f"{round(value, decimals) + 0.0:,.{decimals}f}".replace("-", "−")


def _jumps(ballbar: Ballbar) -> str:
    return f"{ballbar.test.machine.controller.jump_feed_mm_s * 60.0:,.6g}"


def _mm_min(speed_um_s: float) -> str:
    return f"{mm(speed_um_s) * 60.0:,.6g}"
