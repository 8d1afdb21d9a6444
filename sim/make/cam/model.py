"""What is to be cut: figures, how the wire comes to them, the passes over them."""

import math
from collections.abc import Sequence
from typing import Final, Literal, NamedTuple

from controller.offset.shifted import Side
from parser.drawing.model import Drawing, Entity, LeftOut
from parser.findings.catalogue import Remark
from parser.geometry.curves import Curves, Floats, Ints, extents
from parser.toolpath import Point
from sim.make.cam.facing import Facing
from sim.setup.making import LeadIn, Making
from sim.setup.taper import TaperSettings

FigureKind = Literal["hole", "outline"]
ThreadedBy = Literal["asked", "marked", "chosen", "contour", "kerf"]


class Bridge(NamedTuple):
    """A gap of the drawing that is bridged in a contour: the middle between both ends, and how far they lie apart."""

    place_um: Point
    gap_um: float


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
    first
        Its first entity.
    runs_inside
        Whether the wire runs within it, in the waste: of a hole; outside of an outline, unless asked otherwise.
    bridges
        Gaps of the drawing that are bridged in it.
    """

    number: int
    kind: FigureKind
    part: int
    depth: int
    contour: Curves
    entity: Ints
    first: Entity
    runs_inside: bool
    bridges: tuple[Bridge, ...] = ()

    @property
    def layer(self) -> str:
        """The layer of its first entity."""
        return self.first.layer


class Uncut(NamedTuple):
    """A contour that is not cut, closed by lines where it has a gap, and why: as `LeftOut` has it."""

    contour: Curves
    why: str


class Parts(NamedTuple):
    """Figures, and what is cut of none, with what was found doubtful and settled.

    Attributes
    ----------
    figures
        What is cut.
    uncut
        Contours that are not cut, and what would be one if it closed, closed by lines: all that lies around others.
    left_out
        What of the drawing is in no figure, entity by entity.
    notes
        What was found doubtful and settled.
    """

    figures: tuple[Figure, ...]
    uncut: tuple[Uncut, ...]
    left_out: tuple[LeftOut, ...]
    notes: tuple[Remark, ...]

    def without(self, refusals: "Sequence[Refusal | NotProved]") -> "Parts":
        """The parts without the figures that cannot be cut, or fail; of several reasons of one the first is told."""
        why = {number: refusal for refusal in reversed(refusals) for number in refusal.figures}
        uncut = [figure for figure in self.figures if figure.number in why]
        left_out = [_refused(figure, why[figure.number]) for figure in uncut]
        contours = [Uncut(figure.contour, each.why) for figure, each in zip(uncut, left_out, strict=True)]
        return self._replace(
            figures=tuple(figure for figure in self.figures if figure.number not in why),
            uncut=(*self.uncut, *contours),
            left_out=(*self.left_out, *left_out),
        )


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
    figures
        Numbers of the figures that cannot be cut; without them the others may be. None where it is about no figure.
    """

    why: str
    places_um: tuple[Point, ...] = ()
    values: tuple[tuple[str, str], ...] = ()
    figures: tuple[int, ...] = ()


class NotProved(NamedTuple):
    """A figure that fails the proof of a program: its number, and by what, a code or the name of a fault."""

    number: int
    what: str

    @property
    def figures(self) -> tuple[int, ...]:
        """Its number, as `Refusal` has it."""
        return (self.number,)


def _refused(figure: Figure, refusal: "Refusal | NotProved") -> LeftOut:
    """A figure as one that is left out; its place is the one of the refusal that lies nearest to it."""
    if isinstance(refusal, NotProved):
        x, y = figure.contour.start_um[0].tolist()
        values = ("figure", str(refusal.number)), ("what", refusal.what)
        return LeftOut(figure.first, "not-proved", (x, y), values=values)
    low, high = extents(figure.contour)
    x, y = (0.5 * (low.min(axis=0) + high.max(axis=0))).tolist()
    nearest = min(refusal.places_um, key=lambda place: math.hypot(place.x - x, place.y - y), default=Point(x, y))
    return LeftOut(figure.first, refusal.why, (nearest.x, nearest.y), values=refusal.values)


class CannotCutError(Exception):
    """Raised with a `Refusal` where a drawing asks for what cannot be cut, or not for certain; of figures with several.

    Attributes
    ----------
    refusal
        The first of them.
    refusals
        All of them where each is about figures, without which others may be cut; else none.
    """

    def __init__(self, refusal: Refusal, *more: Refusal) -> None:
        super().__init__(refusal.why)
        self.refusal = refusal
        self.refusals = (refusal, *more) if all(each.figures for each in (refusal, *more)) else ()


def refused(why: str, place_um: Floats, values: tuple[tuple[str, str], ...] = ()) -> CannotCutError:
    """What to raise for thread points (k, 2) that cannot be."""
    return CannotCutError(Refusal(why, tuple(Point(x, y) for x, y in place_um.tolist()), values))


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
        Whether it was asked for, stands in the drawing, was chosen, is a place of the contour itself, or one in the
        kerf of another figure.
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
    is_coreless
        Whether the first lead-in takes the slug away, so that nothing falls.
    """

    figure: Figure
    thread: Thread
    side: Side
    is_ccw: bool
    passes: tuple[PassCut, ...]
    cut_off: tuple[PassCut, ...] = ()
    is_coreless: bool = False

    @property
    def all_passes(self) -> tuple[PassCut, ...]:
        """The passes, and those over the tab."""
        return (*self.passes, *self.cut_off)


class Visit(NamedTuple):
    """Passes over a figure in one go.

    Attributes
    ----------
    cut
        Index of the figure's cut in the plan.
    first, past
        Of all passes of that cut, the first one and one past the last.
    is_threaded
        Whether the wire is threaded before it, at the figure's thread point; else it goes on from where the visit
        before it ended.
    has_stop
        Whether it begins behind a stop.
    """

    cut: int
    first: int
    past: int
    is_threaded: bool
    has_stop: bool

    def passes_of(self, cut: FigureCut) -> tuple[PassCut, ...]:
        """Its passes, of its cut."""
        return cut.all_passes[self.first : self.past]


UNCUT: Final = (
    "almost-closed",
    "crosses-itself",
    "crossing",
    "divided",
    "divides",
    "falls-apart",
    "frame",
    "within-open",
    "narrow-neck",
    "narrow-slot",
    "no-room",
    "not-proved",
    "shared-edge",
    "too-near",
    "too-small",
)
"""Why a contour is not cut, or what may be one, though nobody asked for that: it is to be checked."""


class CutPlan(NamedTuple):
    """All that is cut, in running order, with what it was made of.

    `cuts` stand in the order of the figures, `visits` in that in which the wire runs over them.
    `is_added`: the controller adds the offset, and the program, in 4B, does not say it. `taper` is the lean of all
    contours, None of an upright wire. `facings` are the partners of each cut's contour in a second drawing, that of the
    top of the work; empty without one.
    """

    drawing: Drawing
    making: Making
    passes_um: tuple[float, ...]
    cuts: tuple[FigureCut, ...]
    uncut: tuple[Uncut, ...]
    left_out: tuple[LeftOut, ...]
    notes: tuple[Remark, ...]
    visits: tuple[Visit, ...] = ()
    is_added: bool = False
    taper: TaperSettings | None = None
    facings: tuple[Facing, ...] = ()

    @property
    def of_contour(self) -> tuple[int, ...]:
        """The index of the cut that each contour of the program is of: a thread point begins each."""
        return tuple(visit.cut for visit in self.visits if visit.is_threaded)

    @property
    def uncut_entities(self) -> tuple[LeftOut, ...]:
        """Contours and curves that are not cut and might be, each by the first of its entities."""
        return tuple(each for each in self.left_out if each.why in {*UNCUT, "open", "not-picked"})

    @property
    def to_check(self) -> tuple[LeftOut, ...]:
        """Those of them that nobody asked to leave."""
        return tuple(each for each in self.left_out if self.is_to_check(each.why))

    def is_to_check(self, why: str) -> bool:
        """Whether what is not cut for this reason is to be checked: of picked contours, not what nobody can pick."""
        return why in UNCUT and not (self.making.picks and why in {"almost-closed", "divides"})

    @property
    def doubts(self) -> tuple[Remark, ...]:
        """What was read of the drawing and may be meant otherwise: its unit."""
        return tuple(note for note in self.drawing.notes if note.name == "doubtful-unit")
