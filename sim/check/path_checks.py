"""All checks of one program, those of its path among them, and how far each came."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from controller.stepping.steps import Steps, interpolate
from parser.dialect.reader import at_block, in_codes
from parser.findings.codes import Check
from parser.findings.findings import DoubtfulEnd, Finding, Leans, TooLarge, file_order, telling
from parser.geometry.curves import Ints
from parser.program import Program, parse_program
from parser.shape.contours import Contour, contour_rows, find_contours
from parser.shape.passes import find_passes
from parser.toolpath import Toolpath
from sim.check.closures import OpenContour, contour_findings, stepped_end_findings
from sim.check.compensation.check import compensation_of, is_known
from sim.check.geometry import corner_findings, crossing_findings, sense_findings
from sim.check.gouges import gouge_findings
from sim.check.offset import header_offset_findings
from sim.check.passes import followed_findings, pass_findings, tab_findings
from sim.check.radius_rule import radius_rule_findings, vanishing_findings
from sim.check.result import CheckState, Coverage
from sim.check.strokes import doubled_findings, retraced_contours, retraced_findings, swapped_findings
from sim.check.travel import rapid_findings, tab_stop_findings, too_many_steps, travel_findings, uncut_jump_findings

if TYPE_CHECKING:  # most checks know no machine, and most programs do not compensate
    from sim.check.compensation.check import OwnCompensation
    from sim.check.kerf_offsets import Kerfs
    from sim.check.lean import LeanDemands
    from sim.check.offset import Offsetting
    from sim.setup.machine.table import TableModel


class Demands(NamedTuple):
    """What a program is checked against.

    Attributes
    ----------
    table, start_um
        Table that it is to run on, and where its start lies there; None where no table is known.
    offset_um
        Distance of the cut edge from the wire's centre; None where no wire is known.
    may_stay_open
        Whether contours may end away from their own path.
    added_um
        Offset that the controller adds; None where nobody asked for one.
    kerfs
        How wide the wire cuts in each pass; None where no technology is known.
    lean
        What is known of the lean of the wire; None where no height is.
    has_heights
        Whether heights are known to a run, which looks at how the wire leans itself.
    """

    table: "TableModel | None" = None
    start_um: tuple[float, float] | None = None
    offset_um: float | None = None
    may_stay_open: bool = False
    added_um: float | None = None
    kerfs: "Kerfs | None" = None
    lean: "LeanDemands | None" = None
    has_heights: bool = False


class PathChecked(NamedTuple):
    """What the checks of a path found.

    Attributes
    ----------
    findings, states
        In the order of the checks, and how far each check came.
    judged
        Contours without a damaged or endless block; others are not judged.
    compensation
        What the program's own compensation makes of it; None where it asks for none.
    """

    findings: tuple[Finding, ...]
    states: tuple[CheckState, ...]
    judged: tuple[Contour, ...]
    compensation: "Offsetting | None"


def check_path(program: Program, steps: Steps, contours: tuple[Contour, ...], demands: Demands) -> PathChecked:
    """All checks of a path."""
    checks = _PathChecks(program, steps, contours, demands)
    findings: list[Finding] = []
    states: list[CheckState] = []
    for found in checks.run():
        if isinstance(found, CheckState):
            states.append(found)
        else:
            findings.append(found)
    return PathChecked(tuple(findings), tuple(states), checks.judged, checks.compensation)


class _PathChecks:
    """The checks of one path; each gives its findings, then its state."""

    def __init__(self, program: Program, steps: Steps, contours: tuple[Contour, ...], demands: Demands) -> None:
        self._program, self._steps, self._demands = program, steps, demands
        rows = contour_rows(program.toolpath)
        self._broken = _broken_contours(program, rows)
        self.judged = tuple(contour for number, contour in enumerate(contours) if number not in self._broken)
        self._rows = np.where(np.isin(rows, list(self._broken)), -1, rows)
        own = self._own_compensation()
        self.compensation = own.made if own else None
        self._passes = own.drawn_passes if own else find_passes(program.toolpath)
        self._retraced = retraced_contours(program.toolpath, self.judged, self._passes)
        opened = {each.contour.first: each.opened for each in self._retraced}
        self.judged = tuple(opened.get(contour.first, contour) for contour in self.judged)

    def run(self) -> Iterator[Finding | CheckState]:
        """Findings of all path checks, and the states of the checks."""
        program, demands = self._program, self._demands
        stepped = self._stepped()
        yield from stepped
        yield self._steps_state()
        uncut = uncut_jump_findings(program, self._rows, self._passes)
        yield from uncut
        known = (*program.findings, *stepped, *uncut)
        yield from rapid_findings(program)
        closures = contour_findings(program, self.judged, self._rows, known, may_stay_open=demands.may_stay_open)
        yield from closures
        retraced = list(retraced_findings(program, self._retraced))
        yield from retraced
        yield from doubled_findings(program, self._rows, self._passes)
        yield self._state(Check.CONTOURS, self._left_out)
        rows = _closed(self._rows, closures)  # an open contour may not run where it was meant to
        open_ones = "" if rows is self._rows else "reason-open"
        swapped = list(swapped_findings(program, rows, self._passes))
        yield from swapped
        yield from _undoubted(sense_findings(program, rows), (*known, *swapped))
        yield from radius_rule_findings(program, rows, self._offset_um)
        yield self._state(Check.SENSES, self._left_out or open_ones)
        crossings, all_pairs = crossing_findings(program, rows, self._passes)
        yield from crossings
        yield self._state(Check.CROSSINGS, self._left_out or open_ones if all_pairs else "reason-many")
        yield from self._over_edges()
        yield from self._into_parts(_without(rows, [*uncut, *closures, *retraced]))
        yield self._state(Check.PASSES, self._left_out)
        yield from self._asked_for()
        reach_um = demands.offset_um if demands.table is not None else None
        yield from header_offset_findings(program, self._passes, reach_um, demands.added_um)
        yield from self._misfits()
        if self.compensation is not None:
            yield from self.compensation.findings
            yield self._state(Check.COMPENSATION, self._left_out or self._without_value)
        if demands.lean is not None:
            yield from self._leaning(demands.lean)
        elif program.toolpath.leans and not demands.has_heights:
            found = at_block(program.toolpath, program.lines, "ISO601", _first_leaning(program.toolpath))
            yield found.with_fact(Leans())
            yield CheckState(Check.TAPER, "not asked", "reason-no-height")

    def _misfits(self) -> Iterator[Finding]:
        """Findings on offsets that do not fit the kerf of their pass."""
        if self._demands.kerfs is None:
            return
        from sim.check.kerf_offsets import misfits  # noqa: PLC0415 - most checks know no technology

        program, passes, made = self._program, self._passes, self.compensation
        if made is not None:
            program, passes = made.program, made.edge_passes
        header_um = self._program.header.get("offset_um")
        known_um = header_um if isinstance(header_um, float) and header_um > 0.0 else None
        yield from misfits(program, passes, self._demands.kerfs, known_um)

    def _stepped(self) -> list[Finding]:
        """Findings about the words that steps are counted by, where the program has such."""
        return [] if self._program.toolpath.words is None else stepped_end_findings(self._program, self._steps)

    def _steps_state(self) -> CheckState:
        if self._program.toolpath.words is None:
            return CheckState(Check.STEPS, "not asked", "reason-no-words")
        return self._state(Check.STEPS, _stopped(self._program))

    def _own_compensation(self) -> "OwnCompensation | None":
        compensation = compensation_of(self._program.toolpath)
        if compensation is None:
            return None
        from sim.check.compensation.check import own_compensation  # noqa: PLC0415 - other programs start sooner without

        return own_compensation(self._program, compensation, self._rows >= 0)

    def _over_edges(self) -> Iterator[Finding]:
        """Findings about passes over one edge: as they are programmed, as the wire runs, and what they leave uncut."""
        program, rows, passes = self._program, self._rows, self._passes
        yield from followed_findings(program, rows, passes)
        yield from tab_stop_findings(program, rows, passes)
        if not self._demands.may_stay_open:
            yield from tab_findings(program, rows, passes)
        made = self.compensation
        if made is not None:
            program, rows, passes = made.program, rows[made.path.source_row], made.edge_passes
        yield from pass_findings(program, rows, passes, self._demands.offset_um)

    def _into_parts(self, rows: Ints) -> Iterator[Finding]:
        """Findings about leads that cut into the part; `rows` (n,) is each row's contour, −1 where it is in doubt.

        Where a program's own compensation is wrong, that says it: its wire runs on the side of the part.
        """
        program, passes, made = self._program, self._passes, self.compensation
        if made is not None:
            rows = _without(rows, made.findings)
            program, rows, passes = made.program, rows[made.path.source_row], made.edge_passes
        yield from gouge_findings(program, rows, passes)

    def _leaning(self, lean: "LeanDemands") -> Iterator[Finding | CheckState]:
        """Findings about the lean of the wire, and how far their check came; none of an upright one."""
        # Most programs are upright, and start sooner without.
        from sim.check.lean import own_offsets, tilted_path  # noqa: PLC0415
        from sim.check.taper import taper_findings, top_offset_findings  # noqa: PLC0415

        made = self.compensation
        offsets = own_offsets(self._program, made)
        path = tilted_path(self._program, offsets, lean)
        if path is not None:
            program = self._program if made is None else made.program
            yield from taper_findings(program, path, lean.guides, self._demands.table, self._demands.start_um)
            yield from top_offset_findings(program, offsets)
            yield self._state(Check.TAPER, self._left_out or self._without_value)

    @property
    def _without_value(self) -> str:
        """Why the compensation is not all worked out; empty where it is."""
        compensation = compensation_of(self._program.toolpath)
        return "" if compensation is None or is_known(compensation) else "reason-no-register"

    @property
    def _left_out(self) -> str:
        """Why a check of whole contours did not look at all of them; empty where it did."""
        if not self._broken:
            return ""
        return "reason-damaged" if self._program.reading.damages else "reason-endless"

    @property
    def _offset_um(self) -> float | None:
        """What the controller adds: as asked for, as the header says, or as the wire needs it."""
        header_um = self._program.header.get("offset_um")
        return self._demands.added_um or (
            header_um if isinstance(header_um, float) and header_um > 0.0 else self._demands.offset_um
        )

    def _asked_for(self) -> Iterator[Finding | CheckState]:
        """Checks that need to know the wire or the machine."""
        program, demands = self._program, self._demands
        if self.compensation is not None:
            # ISO504 tells of the offset that is known.
            yield self._state(Check.CORNERS, self._left_out or self._without_value)
        elif demands.offset_um is None:
            yield CheckState(Check.CORNERS, "not asked", "reason-no-wire")
        else:
            yield from corner_findings(program, self._rows, self._passes, demands.offset_um)
            yield from vanishing_findings(program, self._rows, self._passes, self._offset_um or demands.offset_um)
            yield self._state(Check.CORNERS, self._left_out)
        if demands.table is None or demands.start_um is None:
            yield CheckState(Check.TRAVEL, "not asked", "reason-no-machine")
        else:
            run, steps = program, self._steps
            if self.compensation is not None:
                run = self.compensation.program
                steps = interpolate(run.toolpath)
            yield from travel_findings(run, steps, demands.table, demands.start_um)
            yield self._state(Check.TRAVEL, "reason-damaged" if program.reading.damages else _stopped(program))

    def _state(self, name: Check, reason: str = "") -> CheckState:
        return state_of(self._program, name, self._program.reading.not_simulated.reason or reason)


def _closed(rows: Ints, closures: list[Finding]) -> Ints:
    """The contour column with −1 for contours that were found open; the same array where there are none."""
    return _without(rows, [finding for finding, _ in telling(closures, OpenContour)])


def _without(rows: Ints, found: Sequence[Finding]) -> Ints:
    """The contour column with −1 for contours with findings at their blocks; the same array where there are none."""
    at = np.array([finding.block - 1 for finding in found if finding.block], dtype=np.int64)
    return np.where(np.isin(rows, rows[at]), -1, rows) if len(at) else rows


def _undoubted(senses: list[Finding], known: tuple[Finding, ...]) -> list[Finding]:
    """Findings about arcs, save where a wrong count length or end explains one: of the arc itself or of a neighbour."""
    doubtful = {finding.block for finding, _ in telling(known, DoubtfulEnd)}
    return [finding for finding in senses if not doubtful & {finding.block - 1, finding.block, finding.block + 1}]


def _broken_contours(program: Program, rows: Ints) -> set[int]:
    """Contours with a block missing in or beside them, or with one that never ends."""
    toolpath = program.toolpath
    before = np.array([damage.after for damage in program.reading.damages], dtype=np.int64)
    near = np.concatenate([before - 1, before, np.flatnonzero(toolpath.is_endless)]).astype(np.int64)
    near = near[(near >= 0) & (near < len(toolpath))]
    return set(rows[near].tolist()) - {-1}


def _first_leaning(toolpath: Toolpath) -> int:
    """The first row in which the wire leans."""
    if toolpath.taper is not None:
        return int(np.argmax(toolpath.taper.side != 0))
    return 0 if toolpath.upper is None else int(np.argmax((toolpath.upper.end_um != toolpath.end_um).any(axis=1)))


def _stopped(program: Program) -> str:
    return "reason-endless" if program.toolpath.is_endless.any() else ""


def state_of(program: Program, name: Check, reason: str) -> CheckState:
    """State of a check: not asked where the text gives no cause for it, else incomplete if there is a reason."""
    causeless = program.reading.not_asked.get(name)
    if causeless:
        return CheckState(name, "not asked", causeless)
    if not reason:
        return CheckState(name, "complete")
    not_simulated = program.reading.not_simulated
    return CheckState(name, "incomplete", reason, not_simulated.words if reason == not_simulated.reason else ())


PARSER_CHECKS = (Check.GRAMMAR, Check.ORDER, Check.BLOCKS, Check.PRINTED_ENDS, Check.HEADER)
PATH_CHECKS = (Check.STEPS, Check.CONTOURS, Check.SENSES, Check.CROSSINGS, Check.PASSES, Check.CORNERS, Check.TRAVEL)


class Checked(NamedTuple):
    """What the checks of a program found.

    Attributes
    ----------
    findings
        In file order.
    coverage
        How far the checks came.
    steps
        Of the program; None where they were not worked out.
    contours, judged
        All contours, and those with no damaged block in or beside them and no block that never ends.
    compensation
        What the program's own compensation makes of it; None where it asks for none, or where it was not worked out.
    """

    findings: tuple[Finding, ...]
    coverage: Coverage
    steps: Steps | None
    contours: tuple[Contour, ...]
    judged: tuple[Contour, ...]
    compensation: "Offsetting | None" = None


def run_checks(program: Program, demands: Demands) -> Checked:
    """Run every check on a program, and blame the word that explains what they find."""
    checked = _every_check(program, demands)
    if not checked.findings:
        return checked
    names = program.toolpath.source.names
    if checked.steps is None:
        return checked._replace(findings=names.named(checked.findings))
    from sim.check.blame.proof import proved  # noqa: PLC0415 - a sound program has nobody to blame, and starts sooner
    from sim.check.blame.settle import settled  # noqa: PLC0415

    def again(text: str) -> tuple[Finding, ...]:
        return _every_check(parse_program(text, program.name, program.encoding, program.choices), demands).findings

    found = settled(program, checked.findings, checked.judged, again)
    return checked._replace(findings=names.named(proved(program, found, checked.judged, again)))


def _every_check(program: Program, demands: Demands) -> Checked:
    if any(telling(program.findings, TooLarge)):
        return _without_path(program, "reason-too-large")
    steps = interpolate(program.toolpath)
    excess = too_many_steps(program, steps)
    if excess:
        return _without_path(program, "reason-too-large", excess)
    contours = find_contours(program.toolpath, steps.corner_um)
    path = check_path(program, steps, contours, demands)
    findings = tuple(sorted([*program.findings, *in_codes(program.reading, path.findings)], key=file_order))
    counts = program.reading.counts
    decoded = counts.run - int(program.toolpath.is_endless.sum())
    states = (*_parser_states(program), *path.states)
    coverage = Coverage(counts.found, counts.whole, decoded, decoded, states)
    return Checked(findings, coverage, steps, contours, path.judged, path.compensation)


def _parser_states(program: Program) -> tuple[CheckState, ...]:
    damaged = program.reading.not_simulated.reason or "reason-damaged" if program.reading.damages else ""
    beyond = "reason-too-large" if any(telling(program.findings, TooLarge)) else damaged
    reasons = {Check.GRAMMAR: "", Check.ORDER: damaged}
    reasons |= dict.fromkeys((Check.BLOCKS, Check.PRINTED_ENDS, Check.HEADER), beyond)
    return tuple(state_of(program, name, reason) for name, reason in reasons.items())


def _without_path(program: Program, reason: str, more: list[Finding] | None = None) -> Checked:
    """Findings of a program whose geometry is not worth working out."""
    names = (*PATH_CHECKS, *((Check.COMPENSATION,) if compensation_of(program.toolpath) else ()))
    states = (*_parser_states(program), *(CheckState(name, "incomplete", reason) for name in names))
    counts = program.reading.counts
    coverage = Coverage(counts.found, counts.whole, 0, 0, states)
    return Checked(tuple(sorted([*program.findings, *(more or [])], key=file_order)), coverage, None, (), ())
