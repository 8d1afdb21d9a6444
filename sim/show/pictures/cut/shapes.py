"""The shapes of a cut in a view, worked out once: in pixels and in both languages the same ones are drawn."""

from typing import TYPE_CHECKING

from sim.show.draw.layout import View
from sim.show.pictures.cut.areas import Areas, areas_of
from sim.show.pictures.cut.lines import Lines, lines_of
from sim.show.pictures.cut.subject import Cut

if TYPE_CHECKING:
    from sim.measure.compare.result import Comparison
    from sim.measure.compare.strips import Strips


class Shapes:
    """Lines and areas of one cut, kept for each view that asked for them, and where it is off its drawing."""

    def __init__(self) -> None:
        self._lines: dict[View, Lines] = {}
        self._areas: dict[View, Areas] = {}
        self._strips: tuple[Strips | None] | None = None  # once it was worked out

    def lines(self, cut: Cut, view: View) -> Lines:
        """The lines of the cut in a view."""
        if view not in self._lines:
            self._lines[view] = lines_of(cut, view)
        return self._lines[view]

    def strips(self, comparison: "Comparison | None") -> "Strips | None":
        """Where the edge of the cut is off its drawing; None where it is nowhere, or there is none."""
        if comparison is None:
            return None
        from sim.measure.compare.strips import strips_of  # noqa: PLC0415 - of a path no comparison is known

        if self._strips is None:
            self._strips = (strips_of(comparison),)
        return self._strips[0]

    def areas(self, cut: Cut, view: View) -> Areas:
        """The areas of the pieces of the cut in a view; none where no pieces are known."""
        if cut.pieces is None:
            return Areas([], [])
        if view not in self._areas:
            self._areas[view] = areas_of(cut.pieces, view)
        return self._areas[view]
