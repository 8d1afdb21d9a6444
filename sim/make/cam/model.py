"""What is to be cut: figures, how the wire comes to them, the passes over them, on which side and which way round.

On which side of each contour the wire runs, and which way round.
"""

from collections.abc import Sequence
from typing import Literal, NamedTuple

from controller.offset.shifted import Side
from parser.drawing.model import Drawing, LeftOut
from parser.findings.catalogue import Remark
from parser.geometry.curves import Curves, Ints
from parser.toolpath import Point
from sim.setup.making import LeadIn, Making, SideWish

FigureKind = Literal["hole", "outline"]
ThreadedBy = Literal["asked", "marked", "chosen", "contour"]


class Figure(NamedTuple):
    """A closed contour that is to be cut.

    Attributes
    ----------
    number
        From 1: the name by which people order it.
    kind
        A hole of a part, or its outline.
    part
        Number of the part, from 1.
    depth
        How many contours it lies within.
    contour
        (m,) as drawn, counter-clockwise, each curve from the end of the one before it, the first from that of the last.
    entity
        (m,) number of the drawing's entity that each is of.
    layer
        That of its first entity.
    runs_inside
        Whether the wire runs within it, in the waste: of a hole; outside of an outline, unless asked otherwise.
    """

    number: int
    kind: FigureKind
    part: int
    depth: int
    contour: Curves
    entity: Ints
    layer: str
    runs_inside: bool


class Parts(NamedTuple):
    """Figures, and what is cut of none, with what was found doubtful and settled."""

    figures: tuple[Figure, ...]
    left_out: tuple[LeftOut, ...]
    notes: tuple[Remark, ...]


class Refusal(NamedTuple):
    """Why there is no program.

    Attributes
    ----------
    why
        Name of a text for people, ``program.refused-…``.
    places_um
        Where it is seen.
    values
        What fills the text.
    """

    why: str
    places_um: tuple[Point, ...] = ()
    values: tuple[tuple[str, str], ...] = ()


class CannotCutError(Exception):
    """Raised with a `Refusal` where a drawing asks for what cannot be cut, or not for certain."""

    def __init__(self, refusal: Refusal) -> None:
        super().__init__(refusal.why)
        self.refusal = refusal


class Entry(NamedTuple):
    """Where the wire comes to a contour.

    Attributes
    ----------
    row, along_um
        Row of the contour, and how far along it, from its start.
    place_um
        That place on the contour.
    out
        Unit vector from it into the waste, across the contour.
    """

    row: int
    along_um: float
    place_um: Point
    out: Point


class Thread(NamedTuple):
    """Where the wire of a figure is threaded, and how it comes to the contour from there.

    Attributes
    ----------
    place_um
        The thread point.
    by
        Whether it was asked for, stands in the drawing, was chosen, or is a place of the contour itself.
    entry
        Where the wire comes to the contour.
    lead
        What is free in the waste: the lead that is asked for, else a straight one.
    """

    place_um: Point
    by: ThreadedBy
    entry: Entry
    lead: LeadIn = "perpendicular"


class PassCut(NamedTuple):
    """One pass over a figure, in running order.

    Attributes
    ----------
    by_um
        Offset from the contour.
    is_back
        Whether it runs against the first pass.
    into, along, out
        Lead-in, way along the contour, lead-out; each curve from the end of the one before it.
    """

    by_um: float
    is_back: bool
    into: Curves
    along: Curves
    out: Curves


class FigureCut(NamedTuple):
    """How a figure is cut.

    Attributes
    ----------
    figure, thread
        The figure, and where the wire of it is threaded.
    side
        Side of the contour on which the wire runs in its first pass, as that runs.
    is_ccw
        Whether the first pass runs counter-clockwise.
    passes
        In running order.
    cut_off
        Passes over the tab, behind a stop; none where there is no tab.
    """

    figure: Figure
    thread: Thread
    side: Side
    is_ccw: bool
    passes: tuple[PassCut, ...]
    cut_off: tuple[PassCut, ...] = ()


class CutPlan(NamedTuple):
    """All that is cut, in running order, with what it was made of.

    `is_added`: the controller adds the offset, and the program, in 4B, does not say it.
    """

    drawing: Drawing
    making: Making
    passes_um: tuple[float, ...]
    cuts: tuple[FigureCut, ...]
    left_out: tuple[LeftOut, ...]
    notes: tuple[Remark, ...]
    is_added: bool = False


_MOST_NAMED = 10


class Way(NamedTuple):
    """Which way round a first pass runs, and on which side of it the contour's wire is then."""

    is_ccw: bool
    side: Side


def with_sides(figures: Sequence[Figure], making: Making) -> tuple[Figure, ...]:
    """The figures with the sides that are asked for, for their layers or for all.

    CannotCutError, ``no-such-layer``, where a layer for which something is asked has no figure: its name may be wrong.
    """
    _refuse_strange(figures, making)
    of_layer = {wish.layer.casefold(): wish.side for wish in making.layers if wish.side is not None}
    return tuple(_with_side(figure, of_layer.get(figure.layer.casefold(), making.side)) for figure in figures)


def _refuse_strange(figures: Sequence[Figure], making: Making) -> None:
    layers = {figure.layer.casefold(): figure.layer for figure in figures}
    strange = [wish.layer for wish in making.layers if wish.layer.casefold() not in layers]
    if strange:
        values = (("layer", strange[0]), ("layers", ", ".join(sorted(layers.values())[:_MOST_NAMED])))
        raise CannotCutError(Refusal("no-such-layer", (), values))


def _with_side(figure: Figure, side: SideWish) -> Figure:
    inside = figure.kind == "hole" if side == "nesting" else side == "inside"
    return figure._replace(runs_inside=inside)


def way_of(figure: Figure, making: Making) -> Way:
    """Which way the first pass over a figure runs.

    ``one-side`` has the wire on its left: counter-clockwise within a contour, clockwise around one.
    """
    is_ccw = figure.runs_inside if making.direction == "one-side" else making.direction == "ccw"
    return Way(is_ccw, Side.LEFT if is_ccw == figure.runs_inside else Side.RIGHT)
