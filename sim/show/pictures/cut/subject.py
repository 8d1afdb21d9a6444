"""What the picture of a cut shows, and the page that it is drawn on."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

from parser.findings.findings import Finding
from parser.geometry.curves import Bools, Floats
from parser.shape.passes import Passes
from parser.toolpath import Toolpath
from sim.show.draw.canvas import Canvas
from sim.show.draw.labels import Room
from sim.show.draw.layout import Page
from sim.show.pictures.cut.outlines import Bodies
from sim.show.texts import Words

if TYPE_CHECKING:  # what only a run has: the picture of a path does without the engine
    from sim.cut.pieces.pieces import Pieces
    from sim.cut.sizes.sizes import Sizes
    from sim.measure.compare.strips import Strips
    from sim.table.trace import Trace

NOTHING: Final = Bodies()


class Cut(NamedTuple):
    """A cut, known as far as it is; all in program coordinates.

    Attributes
    ----------
    toolpath
        The path of the wire's centre, at least one block.
    kerf_um
        Full width of the kerf, twice the sum of wire radius and spark gap; 0 where none is to be drawn.
    title, note
        Lines at the top; the middle of a line that is too long is left out.
    trace
        The way the wire took; where None the kerf lies around the path.
    passes
        Which blocks make each pass over an edge; None where every edge is cut once.
    leads
        (n,) which rows lead into edges and out of them; None where the picture does not tell them apart.
    contour
        What the program draws where a controller adds the offset; None where it runs as written.
    bodies
        The workpiece and the clamps; those near the path show.
    pieces, sizes
        What the cut leaves, and the sizes of what is kept, where they were worked out.
    findings
        What is wrong.
    travel_um
        The box that the table can reach, (2, 2): lowest and highest (x, y).
    off
        Strips between the edge and the drawing that it was held against; None where it is nowhere off, or there is
        none.
    """

    toolpath: Toolpath
    kerf_um: float
    title: str
    note: str = ""
    trace: "Trace | None" = None
    passes: Passes | None = None
    leads: Bools | None = None
    contour: Toolpath | None = None
    bodies: Bodies = NOTHING
    pieces: "Pieces | None" = None
    sizes: "Sizes | None" = None
    findings: Sequence[Finding] = ()
    travel_um: Floats | None = None
    off: "Strips | None" = None


class Board(NamedTuple):
    """A page that is being drawn; what finds its place takes it out of `room`."""

    canvas: Canvas
    page: Page
    room: Room
    say: Words
