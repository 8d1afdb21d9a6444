"""A circular test in rows and lines for people: the same on the terminal and in the picture."""

from typing import NamedTuple

from parser.controller_words import Axis
from parser.units import mm
from sim.run.ballbar.circle import Ballbar
from sim.run.ballbar.figures import NAMES, DeviationParts, Figures, Sense
from sim.show.texts import Words
from sim.show.texts.phrases import machine_name
from sim.table.losses import Loss


class Row(NamedTuple):
    """A name and its value, as text."""

    name: str
    value: str


def setup_rows(ballbar: Ballbar, say: Words) -> list[Row]:
    """What was run."""
    controller = ballbar.test.machine.controller
    cut, jump = _mm_min(controller.cut_step_limit_hz), f"{controller.jump_feed_mm_s * 60.0:,.6g}"
    return [
        Row(say("ballbar.machine"), getattr(machine_name(ballbar.test.machine), say.language)),
        Row(say("ballbar.radius"), f"{mm(float(ballbar.test.radius_um)):g} mm"),
        Row(say("ballbar.feed"), _feed(ballbar, say)),
        Row(say("ballbar.feeds"), say("ballbar.feeds-of-machine", cut=cut, jump=jump)),
        Row(say("ballbar.steps"), say(f"ballbar.steps-{controller.interpolation}")),
    ]


def figure_rows(figures: Figures, say: Words) -> list[Row]:
    """The figures of ISO 230-4, µm."""
    ccw, cw = figures.ccw, figures.cw
    return [
        Row(say("ballbar.circularity-both"), number_text(figures.circularity_um)),
        Row(say("ballbar.circularity"), _ways(ccw.circularity_um, cw.circularity_um, say)),
        Row(say("ballbar.radial-max"), _ways(ccw.radial_max_um, cw.radial_max_um, say)),
        Row(say("ballbar.radial-min"), _ways(ccw.radial_min_um, cw.radial_min_um, say)),
        Row(say("ballbar.mean-radial"), number_text(figures.mean_radial_um)),
        Row(say("ballbar.hysteresis"), number_text(figures.hysteresis_um)),
    ]


def part_rows(parts: DeviationParts, interpolation_um: float, say: Words) -> list[Row]:
    """What the deviation consists of, µm."""
    return [
        Row(say("ballbar.reversal-step"), _axes(*parts.step_um)),
        Row(say("ballbar.reversal-spike"), _axes(parts.spike_um(Axis.X), parts.spike_um(Axis.Y))),
        Row(say("ballbar.radius-change"), _ways(*parts.radius_um, say)),
        Row(say("ballbar.diameters"), number_text(parts.diameters_um)),
        Row(say("ballbar.lag"), number_text(parts.lag_um)),
        Row(say("ballbar.interpolation"), number_text(interpolation_um)),
        Row(say("ballbar.rest"), number_text(parts.rest_um)),
    ]


def loss_text(sense: Sense, loss: Loss, say: Words) -> str:
    """A loss in words."""
    amount = f"{loss.amount_um:+,.0f}" if loss.kind == "lost-steps" else f"{loss.amount_um:+,.1f}"
    return say(
        f"ballbar.loss-{loss.kind}",
        direction=say(f"ballbar.{NAMES[sense]}"),
        axis=Axis(loss.axis).name,
        amount=_minus(amount),
        t=f"{loss.t_s:.3f}",
        x=_minus(f"{mm(loss.x_um):.3f}"),
        y=_minus(f"{mm(loss.y_um):.3f}"),
    )


def um(value: float) -> str:
    """A length in µm."""
    return f"{number_text(value)} µm"


def number_text(value: float) -> str:
    """Two decimals, fewer of what is larger than 100, never −0."""
    decimals = 2 if abs(value) < 100.0 else 1 if abs(value) < 1000.0 else 0
    return _minus(f"{round(value, decimals) + 0.0:,.{decimals}f}")


def _feed(ballbar: Ballbar, say: Words) -> str:
    """The feed, and what the plan made of it where that is less."""
    feed_um_s, run = ballbar.test.feed_um_s, ballbar.run_um_s
    if run < feed_um_s * (1.0 - 1e-6):
        return say("ballbar.feed-planned", asked=_mm_min(feed_um_s), planned=_mm_min(run))
    return say("ballbar.feed-kept", asked=_mm_min(feed_um_s))


def _ways(ccw: float, cw: float, say: Words) -> str:
    return say("ballbar.both-ways", ccw=number_text(ccw), cw=number_text(cw))


def _axes(x: float, y: float) -> str:
    return f"X {number_text(x)}, Y {number_text(y)}"


def _minus(number: str) -> str:
    return number.replace("-", "−")


def _mm_min(speed_um_s: float) -> str:
    return f"{mm(speed_um_s) * 60.0:,.6g}"
