"""Edges along a path, against a walk in small steps."""

import math

import numpy as np
from depth import examples
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from controller.card.engine.entries import Pace, arc, line
from controller.card.engine.events import heads_beyond, rises_through
from controller.card.engine.stretch import path_of_segments

PACE = Pace(1.0, 1.0)
STEP_UM = 0.05

rows = st.lists(
    st.tuples(
        st.booleans(),
        st.integers(-40, 40),
        st.integers(-40, 40),
        st.sampled_from([-400.0, -360.0, -100.0, -45.0, 30.0, 180.0, 300.0, 360.0, 700.0]),
    ),
    min_size=1,
    max_size=4,
)


def path_of(rows):
    segments, at = [], (0.0, 0.0, 0.0, 0.0)
    for is_arc, x, y, degrees in rows:
        if (at[0], at[1]) == (x, y):
            continue
        if is_arc:
            segments.append(arc(1, PACE, at, (0, 1), (float(x), float(y)), math.radians(degrees)))
            turned = (complex(*at[:2]) - complex(x, y)) * np.exp(1j * math.radians(degrees)) + complex(x, y)
            segments[-1] = segments[-1]._replace(end=(turned.real, turned.imag, 0.0, 0.0))
        else:
            segments.append(line(1, PACE, at, (float(x), float(y), 0.0, 0.0)))
        at = segments[-1].end
    assume(segments)
    return path_of_segments(segments)


def walked(path, axis, sense):
    """Path lengths and coordinates, turned so that `sense` is upward, in small steps."""
    along = np.arange(0.0, path.before_um[-1], STEP_UM)
    row = np.searchsorted(path.before_um, along, side="right") - 1
    return along, sense * path.place(row, along - path.before_um[row])[:, axis]


@settings(max_examples=examples(300), deadline=None, derandomize=True)
@given(rows=rows, axis=st.integers(0, 1), place=st.integers(-45, 45), sense=st.sampled_from([1, -1]))
def test_the_first_rise_through_a_place_is_where_a_walk_finds_it(rows, axis, place, sense):
    path = path_of(rows)
    off = place + 0.37  # whole places are where rows begin and end
    along, height = walked(path, axis, sense)
    below = height < sense * off
    rises = np.flatnonzero(below[:-1] & ~below[1:])
    found = rises_through(path, axis, off, sense)
    if len(rises):
        assert along[rises[0]] - 1e-9 <= found <= along[rises[0] + 1] + 1e-9
    else:  # a walk may miss a touch between two steps
        assert found == math.inf or height.max() > sense * off - STEP_UM


@settings(max_examples=examples(300), deadline=None, derandomize=True)
@given(rows=rows, axis=st.integers(0, 1), place=st.integers(-45, 45), sense=st.sampled_from([1, -1]))
def test_the_first_way_on_beyond_a_place_is_where_a_walk_finds_it(rows, axis, place, sense):
    path = path_of(rows)
    off = place + 0.37
    along, height = walked(path, axis, sense)
    onward = np.flatnonzero((height[1:] >= sense * off) & (np.diff(height) > 1e-9))
    found = heads_beyond(path, axis, off, sense)
    if len(onward):
        assert abs(found - along[onward[0]]) <= 2 * STEP_UM
    else:
        assert found == math.inf or height.max() > sense * off - STEP_UM


def test_a_place_on_the_joint_of_two_rows_is_not_missed():
    first = line(1, PACE, (0.0, 0.0, 0.0, 0.0), (0.1 + 0.2, 0.0, 0.0, 0.0))
    second = line(1, PACE, (0.3, 0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
    path = path_of_segments([first, second])
    for place in (0.3, np.nextafter(0.3, 0.0), np.nextafter(0.3, 1.0)):
        assert abs(rises_through(path, 0, place, 1) - 0.3) < 1e-5
