"""What path functions share: coordinates to pulses, and a segment into the list or run at once."""

from controller.card.calls.base import CardBase
from controller.card.core.codes import Code, Refused
from controller.card.engine.entries import NO_LENGTH, Pace, PathEntry, Place, Segment, four
from controller.card.engine.shapes import arc_about, arc_by_radius, check_size, checked_line


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
