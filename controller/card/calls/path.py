"""Path functions: lines and arcs, into the list where it is open, else run at once.

Coordinates are user units from the axis' zero, `GT_MapCnt` pulses each; angles are degrees. An entry starts where the
one before it ends. Refused with 1 are axes that the card lacks, what cannot run at once because something moves, and a
full list; with 2 to 7 what is wrong with the path (`shapes`).
"""

from controller.card.calls.path_base import PathBase
from controller.card.core.call import Double, Long, Short, gt
from controller.card.core.codes import Code, Refused
from controller.card.core.units import UM_S2_PER_PULSE_MS2, UM_S_PER_PULSE_MS
from controller.card.engine.entries import XY, YZ, ZX, Pace, line
from controller.card.engine.speeds import in_pulses


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
