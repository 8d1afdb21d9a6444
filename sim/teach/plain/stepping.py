"""Steps of a block by point-by-point comparison, one after the other: docs/3b.md, section 3."""

from typing import NamedTuple

from sim.teach.plain.blocks import Block
from sim.teach.plain.curves import is_endless, with_axis_named

_SIGN_X = [0, 1, -1, -1, 1]
_SIGN_Y = [0, 1, 1, -1, -1]


class Stepper(NamedTuple):
    """Where a block stands.

    Attributes
    ----------
    x, y
        µm: of a line from its start, of an arc from its centre.
    deviation
        F, by which the next step is chosen.
    count_left
        J that is still to be counted off.
    """

    x: int
    y: int
    deviation: int
    count_left: int


class Way(NamedTuple):
    """A step: by 1 µm along X or along Y."""

    x: int
    y: int


def begun(block: Block) -> Stepper:
    """A block that begins; with nothing left to count where no controller can count it out."""
    count = 0 if is_endless(block) else block.count_um
    if block.turn == 0:
        return Stepper(0, 0, 0, count)
    return Stepper(_SIGN_X[block.quadrant] * block.x, _SIGN_Y[block.quadrant] * block.y, 0, count)


def next_way(block: Block, stepper: Stepper) -> Way:
    """The next step of a block."""
    if block.turn == 0:
        first_is_x = block.quadrant % 2 == 1
        if (stepper.deviation >= 0) == first_is_x:
            return Way(_SIGN_X[block.quadrant], 0)
        return Way(0, _SIGN_Y[block.quadrant])
    return _way_on_arc(block.turn, motion_quadrant(block.turn, stepper.x, stepper.y), stepper.deviation >= 0)


def motion_quadrant(turn: int, x: float, y: float) -> int:
    """Quadrant of the motion on an arc at a place, from its centre; on an axis it is the one that is entered."""
    return _entered(x, y) if turn > 0 else 5 - _entered(x, -y)


def _entered(x: float, y: float) -> int:
    """Quadrant that is entered counter-clockwise."""
    if x > 0 and y >= 0:
        return 1
    if x <= 0 and y > 0:
        return 2
    return 3 if x < 0 and y <= 0 else 4


def _way_on_arc(turn: int, quadrant: int, is_outside: bool) -> Way:
    """The table of docs/3b.md: toward the centre where F ≥ 0, away from it else."""
    steps_x_inward = (quadrant % 2 == 1) == (turn > 0)
    if steps_x_inward:
        return Way(-_SIGN_X[quadrant], 0) if is_outside else Way(0, _SIGN_Y[quadrant])
    return Way(0, -_SIGN_Y[quadrant]) if is_outside else Way(_SIGN_X[quadrant], 0)


def stepped(block: Block, stepper: Stepper) -> Stepper:
    """A block after its next step."""
    way = next_way(block, stepper)
    x, y = stepper.x + way.x, stepper.y + way.y
    left = stepper.count_left - (abs(way.x) if block.axis == 0 else abs(way.y))
    if block.turn == 0:
        named = with_axis_named(block)
        gained = -named.y if way.x != 0 else named.x
        return Stepper(x, y, stepper.deviation + (gained if block.quadrant % 2 == 1 else -gained), left)
    change = 2 * (way.x * stepper.x + way.y * stepper.y) + 1
    return Stepper(x, y, stepper.deviation + change, left)


def after_steps(block: Block, steps: int) -> Stepper:
    """A block after so many steps, or where it ends before."""
    stepper = begun(block)
    for _ in range(steps):
        if stepper.count_left <= 0:
            return stepper
        stepper = stepped(block, stepper)
    return stepper
