"""Mark of a block: which of its words are right, as a share from 0 to 1."""

from typing import NamedTuple

from sim.teach.plain.blocks import Block, read_listing
from sim.teach.plain.curves import Point, curve_of, with_axis_named
from sim.teach.plain.tasks import Task


class WordsMark(NamedTuple):
    """What of a block is right: whether it can be read, each of its words, its end, µm, and the share that is right."""

    is_read: bool
    x: bool
    y: bool
    count_length: bool
    axis: bool
    sense: bool
    end: Point
    share: float


def words_mark(task: Task, text: str) -> WordsMark:
    """Mark of a block that was written for a task: a fifth for each of X, Y, J, G and Z."""
    listing = read_listing(text)
    if len(listing.blocks) != 1 or len(listing.unread) > 0:
        return WordsMark(False, False, False, False, False, False, task.start, 0.0)
    right, block = task.block, with_axis_named(listing.blocks[0])
    is_ratio = _are_alike(block, right)
    x, y = is_ratio or block.x == right.x, is_ratio or block.y == right.y
    sense = block.turn == right.turn and block.quadrant == right.quadrant
    count, axis = block.count_um == right.count_um, block.axis == right.axis
    wrong = 0
    for is_right in [x, y, count, axis, sense]:
        wrong += 0 if is_right else 1
    return WordsMark(True, x, y, count, axis, sense, curve_of(block, task.start).end, (5 - wrong) / 5)


def _are_alike(block: Block, right: Block) -> bool:
    """Whether two lines have the same ratio X:Y."""
    are_lines = right.turn == 0 and block.turn == 0 and block.x + block.y > 0
    return are_lines and block.x * right.y == block.y * right.x
