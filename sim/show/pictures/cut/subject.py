"""What the picture of a cut shows."""

from collections.abc import Sequence
from typing import Final, NamedTuple

from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.toolpath import Toolpath
from sim.cut.pieces.pieces import Pieces
from sim.cut.sizes.sizes import Sizes
from sim.show.pictures.cut.outlines import Bodies
from sim.table.trace import Trace

NOTHING: Final = Bodies()


class Cut(NamedTuple):
    """A cut, known as far as it is; all in program coordinates.

    Attributes
    ----------
    toolpath
        The path of the wire's centre, at least one block.
    kerf_um
        Full width of the kerf, twice the sum of wire radius and spark gap; not negative.
    title, note
        Lines at the top; the middle of a line that is too long is left out.
    trace
        The way the wire took; where None the kerf lies around the path.
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
    """

    toolpath: Toolpath
    kerf_um: float
    title: str
    note: str = ""
    trace: Trace | None = None
    contour: Toolpath | None = None
    bodies: Bodies = NOTHING
    pieces: Pieces | None = None
    sizes: Sizes | None = None
    findings: Sequence[Finding] = ()
    travel_um: Floats | None = None
