"""Lines and arcs as path calls give them, made into segments, or refused with the code for what is wrong with them.

What is too large for the card is refused with 3, whatever it is.
"""

import math

from controller.card.core.codes import Code, Refused
from controller.card.engine.entries import Pace, Place, Segment, arc, line

XY, YZ, ZX = (0, 1), (1, 2), (2, 0)
"""Planes as pairs of axes from 0; a positive turn goes from the first toward the second."""
_LARGEST = float(1 << 31)
"""Pulses; what is beyond fits no counter of the card. Grade C."""
_ROUNDING = 1e-9
"""Part of the diameter by which a chord may be longer, from rounding."""


def checked_line(number: int, pace: Pace, start: Place, end: Place) -> Segment:
    """Refused with 3 where it has no length or is too long."""
    check_size(*end)
    made = line(number, pace, start, end)
    if not made.length_um > 0.0:
        raise Refused(Code.LENGTH)
    return made


def arc_about(  # noqa: PLR0913, PLR0917 - an arc has these
    number: int, pace: Pace, start: Place, plane: tuple[int, int], centre: tuple[float, float], degrees: float
) -> Segment:
    """Refused with 2 where the centre is the start, with 7 where the angle is 0 or beyond a full turn."""
    if not 0.0 < abs(degrees) <= 360.0:
        raise Refused(Code.PARAMETER)
    return _about(number, pace, start, plane, centre, math.radians(degrees))


def arc_by_radius(  # noqa: PLR0913, PLR0917 - an arc has these
    number: int, pace: Pace, start: Place, plane: tuple[int, int], end: tuple[float, float], radius: float, sense: int
) -> Segment:
    """The minor arc for a positive radius, the major one for a negative; sense +1 or −1.

    Refused with 2 where radius or chord is 0, with 5 where the chord is longer than the diameter, with 7 for another
    sense.
    """
    if sense not in (1, -1):
        raise Refused(Code.PARAMETER)
    check_size(*end, radius)
    at = (start[plane[0]], start[plane[1]])
    chord = math.dist(at, end)
    if not chord or not radius:
        raise Refused(Code.RADIUS)
    half = chord / (2.0 * abs(radius))
    if half > 1.0 + _ROUNDING:
        raise Refused(Code.CHORD)
    angle = 2.0 * math.asin(min(half, 1.0))
    sweep = sense * (angle if radius > 0.0 else 2.0 * math.pi - angle)
    # The centre lies on the chord's middle line, to its left for a minor arc to the left.
    aside = math.sqrt(max(radius * radius - chord * chord / 4.0, 0.0)) * math.copysign(1.0, radius * sense) / chord
    u, v = end[0] - at[0], end[1] - at[1]
    centre = (at[0] + u / 2.0 - v * aside, at[1] + v / 2.0 + u * aside)
    return _ending(_about(number, pace, start, plane, centre, sweep), plane, end)


def arc_to(  # noqa: PLR0913, PLR0917 - an arc has these
    number: int,
    pace: Pace,
    start: Place,
    plane: tuple[int, int],
    centre: tuple[float, float],
    end: tuple[float, float],
    sense: int,
) -> Segment:
    """About a centre as far as the direction of an end, a full turn where that is the direction of the start.

    Refused with 2 where start or end is the centre.
    """
    check_size(*end)
    first = math.atan2(start[plane[1]] - centre[1], start[plane[0]] - centre[0])
    last = math.atan2(end[1] - centre[1], end[0] - centre[0])
    turn = math.fmod(sense * (last - first), 2.0 * math.pi)
    sweep = turn if turn > 0.0 else turn + 2.0 * math.pi
    if end == centre:
        raise Refused(Code.RADIUS)
    return _ending(_about(number, pace, start, plane, centre, sense * sweep), plane, end)


def _about(  # noqa: PLR0913, PLR0917 - an arc has these
    number: int, pace: Pace, start: Place, plane: tuple[int, int], centre: tuple[float, float], sweep_rad: float
) -> Segment:
    if (start[plane[0]], start[plane[1]]) == centre:
        raise Refused(Code.RADIUS)
    check_size(*centre)
    made = arc(number, pace, start, plane, centre, sweep_rad)
    check_size(*made.end)
    return made


def check_size(*values: float) -> None:
    """Refused with 3 where a number is too large, or has become none on its way to pulses."""
    if not all(abs(value) < _LARGEST for value in values):
        raise Refused(Code.LENGTH)


def _ending(segment: Segment, plane: tuple[int, int], end: tuple[float, float]) -> Segment:
    """The segment with the end that was asked for, without the rounding of its angle."""
    place = list(segment.end)
    place[plane[0]], place[plane[1]] = end
    x, y, z, a = place
    return segment._replace(end=(x, y, z, a))
