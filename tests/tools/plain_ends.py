"""Random paths of lines and arcs, and where blocks end by the plain rules of the tests."""

import numpy as np
from plain import PlainBlock
from sound_cam import plain_end

from parser.controller_words import Axis, StepWords
from parser.geometry.curves import Curves, Floats, curves_between
from parser.step_words.words import label


def random_path(seed: int, n: int, reach_um: float) -> Curves:
    """Lines and arcs of any sweep between random places."""
    rng = np.random.default_rng(seed)
    place = np.cumsum(rng.uniform(-reach_um, reach_um, (n + 1, 2)), axis=0)
    by = np.diff(place, axis=0)
    normal = np.column_stack([-by[:, 1], by[:, 0]])
    center = place[:-1] + 0.5 * by + normal * rng.uniform(-2.0, 2.0, (n, 1))
    low, high = (np.arctan2(*(at - center).T[::-1]) for at in (place[:-1], place[1:]))
    turn = rng.choice([-1.0, 0.0, 1.0], n)
    return curves_between(place[:-1], place[1:], center, (high - low) * turn % (2.0 * np.pi) * turn)


def plain_ends(words: StepWords, start: Floats) -> Floats:
    """Ends of blocks one behind the other, by the plain rules of the tests."""
    at, ends = start, []
    for row in range(len(words.x_um)):
        sense = label(int(words.turn[row]), int(words.quadrant[row]))
        x, y, count = (int(column[row]) for column in (words.x_um, words.y_um, words.count_um))
        by = plain_end(PlainBlock(x, y, count, Axis(int(words.count_axis[row])).name, sense[:-1], int(sense[-1])))
        at = at + np.array(by)
        ends.append(at)
    return np.array(ends)
