"""What a proof says: `Proof`, with the faults that it found by itself beside the findings of check and run."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal, NamedTuple

from parser.findings.catalogue import Remark
from parser.findings.codes import Severity
from parser.findings.findings import Finding, TightCorner, Value
from parser.toolpath import Point
from sim.make.cam.model import NotProved
from sim.measure.compare.result import Comparison
from sim.run.dryrun import DryRun
from sim.setup.wire import Wire

Verdict = Literal["pass", "fail", "incomplete"]


class Fault(NamedTuple):
    """What a proof found wrong by itself.

    Attributes
    ----------
    name
        Of its text for people, ``program.fault-…``.
    values
        What fills the text; lengths in µm, those that end on ``_mm`` in mm.
    place_um
        Where it is seen; None where it has no one place.
    figure
        Number of the figure that it is of; 0 where it is of none.
    block
        Number of the block that it is of; 0 where it is of none.
    """

    name: str
    values: Mapping[str, Value] = MappingProxyType({})
    place_um: Point | None = None
    figure: int = 0
    block: int = 0


class Faces(NamedTuple):
    """The edge as cut at the upper and lower face of the work, beside the drawing, where the wire lags by less."""

    lag_um: float
    comparison: Comparison


class WallOff(NamedTuple):
    """How far the wall of a figure lies off at a height over the bottom of the work, and where; infinity: no wall."""

    figure: int
    z_um: float
    off_um: float
    where_um: Point


class Proof(NamedTuple):
    """What reading, checking and running a written program shows, beside its drawing.

    Attributes
    ----------
    run
        The run; None where the program could not be run at all.
    written_um
        How far the written path lies off that which was planned.
    path
        The edge beside the written path and the contours of the drawing that are to be cut; None where there is none.
    comparison
        The edge as cut beside the same contours; None where there is none.
    findings
        Of the check, the run and the comparison of the edge as cut.
    faults
        What the proof found wrong besides.
    unproved
        What could not be proved, and why: names of texts ``program.unproved-…``.
    notes
        What was assumed: names of texts ``program.proof-…``.
    wire
        What the program was run with.
    at_fault
        The figures that fail where others do not, each with what it fails by.
    faces
        The edge at the upper and lower face of the work; None where no lag is corrected, or none is known there.
    walls
        How far walls lie off at each height; empty of an upright wire.
    """

    run: DryRun | None
    written_um: float
    path: Comparison | None
    comparison: Comparison | None
    findings: tuple[Finding, ...]
    faults: tuple[Fault, ...]
    unproved: tuple[Remark, ...]
    notes: tuple[Remark, ...]
    wire: Wire
    at_fault: tuple[NotProved, ...] = ()
    faces: Faces | None = None
    walls: tuple[WallOff, ...] = ()

    @property
    def counting(self) -> tuple[Finding, ...]:
        """The findings that speak against the program: a made one has no warning either.

        But for corners that a wire cannot cut as the path has them, where the edge was held against the drawing.
        """
        is_held = self.comparison is not None
        grave = (finding for finding in self.findings if finding.severity is not Severity.NOTE)
        return tuple(each for each in grave if not (is_held and isinstance(each.fact, TightCorner)))

    @property
    def verdict(self) -> Verdict:
        """Whether the program may be written: ``incomplete`` where nothing is wrong, and not all could be proved."""
        if self.counting or self.faults:
            return "fail"
        return "incomplete" if self.unproved else "pass"

    @property
    def path_um(self) -> float | None:
        """How far the written path lies at most from the offset of the drawing, both ways; None where not known."""
        return None if self.path is None else self.path.max_um
