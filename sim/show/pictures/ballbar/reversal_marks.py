"""What stands at the four ends of the axes: steps and spikes of the reversals there."""

from typing import Final

import numpy as np

from parser.geometry.curves import Floats
from sim.run.ballbar.parts import Reversal
from sim.run.ballbar.rows import um
from sim.run.ballbar.turn import NAMES
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.dial import RIM, Dial
from sim.show.draw.paints import Paint
from sim.show.pictures.ballbar.dial import COLOURS

LINE: Final = 27.0
GAP: Final = 14.0
SPIKE: Final = 8.0
SPIKE_WIDTH: Final = 2.5

Lines = list[tuple[str, Paint]]


def write_reversals(canvas: Canvas, dial: Dial, reversals: tuple[Reversal, ...]) -> None:
    """Write at each end of the axes what the eight reversals do there."""
    for quarter in range(4):
        here = (reversals[quarter], reversals[4 + quarter])
        lines = _beside(here) if quarter % 2 == 0 else _above(here)
        _write(canvas, dial, quarter, [(_name(here[0]), Paint.INK), *lines])


def mark_spike(canvas: Canvas, place_px: Floats, reversal: Reversal, unit: float) -> None:
    """Ring the top of a spike."""
    canvas.ring(place_px, SPIKE * unit, COLOURS[reversal.sense], SPIKE_WIDTH * unit)


def _name(reversal: Reversal) -> str:
    return f"{reversal.side.replace('-', '−')}{reversal.axis.name}, {reversal.axis.name} reverses"


def _beside(here: tuple[Reversal, ...]) -> Lines:
    """Short lines, a figure each."""
    return [(text, COLOURS[reversal.sense]) for reversal in here for text in _texts(reversal)]


def _above(here: tuple[Reversal, ...]) -> Lines:
    """A line for each direction."""
    return [(", ".join(_texts(reversal)), COLOURS[reversal.sense]) for reversal in here]


def _texts(reversal: Reversal) -> list[str]:
    step = f"{NAMES[reversal.sense]}: step {um(reversal.step_um)}"
    return [step] + [f"spike {um(reversal.spike_um)}"] * (reversal.spike_deg is not None)


def _write(canvas: Canvas, dial: Dial, quarter: int, lines: Lines) -> None:
    """Write lines outward of the rim: beside it in the middle of their height, else above or below it."""
    unit = dial.unit
    x, y = dial.at(np.array(quarter * np.pi / 2.0), (RIM + GAP) * unit).tolist()
    share, align = ((0.5, 0.0), (1.0, 0.5), (0.5, 1.0), (0.0, 0.5))[quarter]
    top = y - share * (len(lines) - 1) * LINE * unit
    for row, (text, paint) in enumerate(lines):
        canvas.text((x, top + row * LINE * unit), text, style.NUMBER * unit, paint, align=align)
