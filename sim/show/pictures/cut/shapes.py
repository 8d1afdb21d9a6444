"""The shapes of a cut in a view, worked out once: in pixels and in both languages the same ones are drawn."""

from sim.show.draw.layout import View
from sim.show.pictures.cut.areas import Areas, areas_of
from sim.show.pictures.cut.lines import Lines, lines_of
from sim.show.pictures.cut.subject import Cut


class Shapes:
    """Lines and areas of one cut, kept for each view that asked for them."""

    def __init__(self) -> None:
        self._lines: dict[View, Lines] = {}
        self._areas: dict[View, Areas] = {}

    def lines(self, cut: Cut, view: View) -> Lines:
        """The lines of the cut in a view."""
        if view not in self._lines:
            self._lines[view] = lines_of(cut, view)
        return self._lines[view]

    def areas(self, cut: Cut, view: View) -> Areas:
        """The areas of the pieces of the cut in a view; none where no pieces are known."""
        if cut.pieces is None:
            return Areas([], [])
        if view not in self._areas:
            self._areas[view] = areas_of(cut.pieces, view)
        return self._areas[view]
