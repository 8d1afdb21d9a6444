"""What path functions share: coordinates to pulses, and a segment into the list or run at once.

The step interface, ours and not the library's: 3B blocks that the card steps point by point.

Path functions: lines and arcs, into the list where it is open, else run at once.

Coordinates are user units from the axis' zero, `GT_MapCnt` pulses each; angles are degrees. An entry starts where the
one before it ends. Refused with 1 are axes that the card lacks, what cannot run at once because something moves, and a
full list; with 2 to 7 what is wrong with the path (`shapes`).
"""

import math

from controller.card.calls.base import CardBase
from controller.card.core.call import Code, Double, Long, Refused, Short, gt
from controller.card.core.settings import UM_S2_PER_PULSE_MS2, UM_S_PER_PULSE_MS
from controller.card.engine.entries import (
    NO_LENGTH,
    XY,
    YZ,
    ZX,
    Pace,
    PathEntry,
    Place,
    Segment,
    Stepped,
    arc_about,
    arc_by_radius,
    check_size,
    checked_line,
    four,
    line,
)
from controller.card.engine.speeds import in_pulses


class PathBase(CardBase):
    """Path entries."""

    def _line(self, values: tuple[float, ...], *, rapid: bool = False) -> None:
        number, pace, start = self._next(rapid=rapid)
        self._submit(with_length(checked_line(number, pace, start, self._pulses(values, start))))

    def _arc_about(self, plane: tuple[int, int], centre: tuple[float, float], degrees: float) -> None:
        at = self._in_plane(plane, centre)
        self._submit(with_length(arc_about(*self._next(), plane, at, degrees)))

    def _arc_to(self, plane: tuple[int, int], end: tuple[float, float], radius: float, sense: int) -> None:
        at = self._in_plane(plane, end)
        pulses = radius * self._state.axes[plane[0]].map_count
        self._submit(with_length(arc_by_radius(*self._next(), plane, at, pulses, sense)))

    def _next(self, *, rapid: bool = False) -> tuple[int, Pace, Place]:
        """Number, pace and start of the entry that comes next."""
        engine = self._engine
        start = engine.list_end() if engine.list.is_open else engine.motion.place()
        return max(1, engine.list.number), engine.speeds.pace(rapid=rapid), start

    def _submit(self, entry: PathEntry) -> None:
        """Put a path entry into the open list, or run it at once. It uses up the end speed that was set for it."""
        self._check_axes(entry)
        if isinstance(entry, Segment):
            entry = self._of_this_call(entry)
        if self._engine.list.is_open:
            self._engine.check_room()
            self._engine.push(entry)
        elif isinstance(entry, Segment):
            self._engine.move(entry)
        else:
            raise Refused(Code.COMMAND)
        self._engine.speeds.end_um_s = None

    def _of_this_call(self, segment: Segment) -> Segment:
        return segment._replace(call=self._logged + 1)

    def _check_axes(self, entry: PathEntry) -> None:
        """Refused with 1 where an axis that it moves is off, if the settings want that."""
        if not self.settings.needs_axis_on:
            return
        if isinstance(entry, Segment):
            moves = [t != 0.0 or n != 0.0 for t, n in zip(entry.tangent, entry.normal, strict=True)]
        else:
            moves = [True, True]
        if not all(own.enabled for moved, own in zip(moves, self._state.axes, strict=False) if moved):
            raise Refused(Code.COMMAND)

    def _pulses(self, values: tuple[float, ...], start: Place) -> Place:
        """Place of coordinates X, Y, …; the other axes stay.

        Refused with 1 where the card lacks an axis, with 3 where it is too far.
        """
        if len(values) > self.settings.axes:
            raise Refused(Code.COMMAND)
        place = four((*(self._of_axis(axis, value) for axis, value in enumerate(values)), *start[len(values) :]))
        check_size(*place)
        return place

    def _in_plane(self, plane: tuple[int, int], values: tuple[float, float]) -> tuple[float, float]:
        """Pulses of two coordinates. Refused with 1 where the card lacks an axis, with 6 where units differ."""
        first, second = plane
        if max(plane) >= self.settings.axes:
            raise Refused(Code.COMMAND)
        if self._state.axes[first].map_count != self._state.axes[second].map_count:
            raise Refused(Code.MAP)
        return self._of_axis(first, values[0]), self._of_axis(second, values[1])

    def _of_axis(self, axis: int, value: float) -> float:
        own = self._state.axes[axis]
        return value * own.map_count + own.zero


def with_length(segment: Segment) -> Segment:
    """Refused with 3 where the segment has none."""
    if not segment.length_um > NO_LENGTH:
        raise Refused(Code.LENGTH)
    return segment


_LARGEST_UM = 1 << 30
"""Words up to this keep squares of radii within whole numbers of 64 bit."""


class StepCalls(PathBase):
    """Stepped blocks."""

    @gt()
    def step_block(
        self, x_um: Long, y_um: Long, count_um: Long, axis: Long, quadrant: Long, turn: Long, length_um: Double
    ) -> None:
        """Put one 3B block into the open list, as a path entry; refused with 1 where the list is closed or full.

        Parameters
        ----------
        x_um, y_um, count_um, quadrant, turn
            Its words, as in `StepWords`; refused with 7 where there are none like them.
        axis
            Counted axis: 0 X, 1 Y.
        length_um
            Length of its ideal line or arc. Refused with 3 where it has none, is endless or too long, or where the
            count is more than double what the length can hold.
        """
        if x_um < 0 or y_um < 0 or count_um < 0 or axis not in (0, 1) or turn not in (-1, 0, 1):
            raise Refused(Code.PARAMETER)
        if quadrant not in (1, 2, 3, 4):
            raise Refused(Code.PARAMETER)
        counted, radius = (x_um, y_um)[axis], math.hypot(x_um, y_um)
        # The way of a line is its count times its length over its counted extent; an arc is as long as its count.
        least = count_um if turn else count_um * radius / counted if counted else math.inf
        runs = count_um > 0 and length_um > 0.0 and (not turn or radius > 1.0)
        if not runs or max(x_um, y_um) > _LARGEST_UM or least > 2.0 * length_um + 4.0 or length_um > _LARGEST_UM:
            raise Refused(Code.LENGTH)
        engine = self._engine
        number, pace = max(1, engine.list.number), engine.speeds.pace(rapid=False)
        self._submit(Stepped(number, pace, x_um, y_um, count_um, axis, quadrant, turn, length_um))


class MoveCalls(PathBase):
    """Positioning moves: in the list, mostly its first entry, or at once (grade C).

    Speed and acceleration become those of the entries that follow. The move may have no length. Refused with 4 where
    speed or acceleration is 0 or less.
    """

    @gt()
    def GT_MvXY(self, x: Double, y: Double, vel: Double, accel: Double) -> None:
        """Move X and Y."""
        self._position((x, y), vel, accel)

    @gt()
    def GT_MvXYZ(self, x: Double, y: Double, z: Double, vel: Double, accel: Double) -> None:
        """Move X, Y and Z."""
        self._position((x, y, z), vel, accel)

    @gt()
    def GT_MvXYZA(self, x: Double, y: Double, z: Double, a: Double, vel: Double, accel: Double) -> None:
        """Move X, Y, Z and A."""
        self._position((x, y, z, a), vel, accel)

    def _position(self, values: tuple[float, ...], vel: float, accel: float) -> None:
        engine, speeds = self._engine, self._engine.speeds
        speed = in_pulses(vel, self.settings, self._state) * UM_S_PER_PULSE_MS
        acceleration = in_pulses(accel, self.settings, self._state) * UM_S2_PER_PULSE_MS2
        start = engine.list_end() if engine.list.is_open else engine.motion.place()
        end = self._pulses(values, start)
        pace = Pace(speed, acceleration, end_um_s=speeds.end_um_s)
        self._submit(line(engine.list.number if engine.list.is_open else 0, pace, start, end))
        speeds.speed_um_s, speeds.acceleration_um_s2 = speed, acceleration


class LineCalls(PathBase):
    """Straight lines to an end; ``G0`` ones are rapid. Refused with 3 without length, or too long."""

    @gt()
    def GT_LnXY(self, x: Double, y: Double) -> None:
        """Line in X and Y."""
        self._line((x, y))

    @gt()
    def GT_LnXYG0(self, x: Double, y: Double) -> None:
        """Rapid line in X and Y."""
        self._line((x, y), rapid=True)

    @gt()
    def GT_LnXYZ(self, x: Double, y: Double, z: Double) -> None:
        """Line in X, Y and Z."""
        self._line((x, y, z))

    @gt()
    def GT_LnXYZG0(self, x: Double, y: Double, z: Double) -> None:
        """Rapid line in X, Y and Z."""
        self._line((x, y, z), rapid=True)

    @gt()
    def GT_LnXYZA(self, x: Double, y: Double, z: Double, a: Double) -> None:
        """Line in X, Y, Z and A."""
        self._line((x, y, z, a))

    @gt()
    def GT_LnXYZAG0(self, x: Double, y: Double, z: Double, a: Double) -> None:
        """Rapid line in X, Y, Z and A."""
        self._line((x, y, z, a), rapid=True)


class ArcCalls(PathBase):
    """Arcs, positive from the first axis of their name toward the second.

    About a centre by an angle: refused with 2 where the centre is the start, with 7 where the angle is 0 or beyond ±360
    (grade C). To an end with a radius, the minor arc for a positive and the major one for a negative radius, `dir` +1
    or −1: refused with 2 where radius or chord is 0, with 5 where the chord is longer than the diameter, with 7 for
    another sense. With 6 where one user unit is not the same on both axes: the arc would be an ellipse (grade C).
    """

    @gt()
    def GT_ArcXY(self, x_center: Double, y_center: Double, angle: Double) -> None:
        """Arc in X and Y about a centre."""
        self._arc_about(XY, (x_center, y_center), angle)

    @gt()
    def GT_ArcYZ(self, y_center: Double, z_center: Double, angle: Double) -> None:
        """Arc in Y and Z about a centre."""
        self._arc_about(YZ, (y_center, z_center), angle)

    @gt()
    def GT_ArcZX(self, z_center: Double, x_center: Double, angle: Double) -> None:
        """Arc in Z and X about a centre."""
        self._arc_about(ZX, (z_center, x_center), angle)

    @gt()
    def GT_ArcXYP(self, x_end: Double, y_end: Double, r: Double, dir: Short) -> None:
        """Arc in X and Y to an end."""
        self._arc_to(XY, (x_end, y_end), r, dir)

    @gt()
    def GT_ArcYZP(self, y_end: Double, z_end: Double, r: Double, direction: Short) -> None:
        """Arc in Y and Z to an end."""
        self._arc_to(YZ, (y_end, z_end), r, direction)

    @gt()
    def GT_ArcZXP(self, z_end: Double, x_end: Double, r: Double, direction: Short) -> None:
        """Arc in Z and X to an end."""
        self._arc_to(ZX, (z_end, x_end), r, direction)

    @gt()
    def GT_ScrewXYP(self, EndX: Long, EndY: Long, R: Long, Dir: Short, ScrewPitch: Long) -> None:
        """Refused with 1: no program shows what it does, and a path must not be left out unnoticed (grade C)."""
        raise Refused(Code.COMMAND)
