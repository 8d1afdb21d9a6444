"""A program checked, written in another language, read back, checked again and held against what it was written of.

Contours that the path of a wire leaves open, and its kerf closes.

What a conversion loses, or writes otherwise, told before anybody misses it.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from controller.taper.tilted import section_toolpath
from controller.taper.two_contours import matched_offsets
from parser.controller_words import Compensation, StepWords
from parser.dialect.reader import Choices, Registers
from parser.findings.codes import Severity
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, Leans, NotSimulated, telling
from parser.geometry.curves import CurveKind
from parser.geometry.distance import distance_to_curves
from parser.program import Program, load_program, paired
from parser.toolpath import Toolpath
from parser.units import mm
from parser.write.draft import OF_THE_FAMILY, Draft, Written
from parser.write.losses import CarriedOver, Loss, lost_words, some
from sim.check.closures import OpenContour
from sim.check.lean import own_offsets
from sim.check.path_checks import Checked, Demands, run_checks
from sim.make.conversion_proof import Proof, proof
from sim.make.wanted import Wanted, carried_events, draft_for, read_with, written

_ANGLES: Final = "AT"


def losses(program: Program, path: Toolpath, draft: Draft, made: Written, wanted: Wanted) -> tuple[Loss, ...]:
    """What the written text does not have of a program, in the order in which it is told.

    `path` is what was drafted of it, as programmed or as the controller runs it.
    """
    words = program.toolpath.words
    if words is not None:
        of_text = _lost_fields(program, words, wanted)
    else:
        of_text = lost_words(program.text, _carried(program, path, wanted)) if program.decoder is not None else ()
    found = (*of_text, *_lost_offsets(program.toolpath, wanted), *_changed_rows(path, draft, made, wanted))
    return tuple(loss for loss in found if loss.number)


def _carried(program: Program, path: Toolpath, wanted: Wanted) -> CarriedOver:
    """What of the words of an ISO program beside its path is written."""
    if wanted.pmac is not None and wanted.pmac.blocks is not None:
        return CarriedOver(letters="FZ", dwells=True)
    events = carried_events(program, path, wanted)
    angles = _ANGLES if program.toolpath.taper is not None else ""
    if events is None:
        return CarriedOver(letters=angles)
    is_own = not all(event.is_common for event in events)
    return CarriedOver(letters=(OF_THE_FAMILY if is_own else "") + angles, dwells=True, optional_stops=True)


def _lost_fields(program: Program, words: StepWords, wanted: Wanted) -> tuple[Loss, ...]:
    """What stands in 3B and 4B beside their blocks, and what their words say otherwise than they would be told."""
    longer = np.maximum(words.x_um, words.y_um)
    reduced = (words.turn == 0) & (longer != words.count_um) & (program.toolpath.kind != CurveKind.JUMP)
    header = any(bool(value) for value in program.header.values())
    prints = not bool(np.isnan(program.toolpath.printed_end_um).all())
    return (
        Loss("header", "", int(header and wanted.form != "detailed")),
        Loss("remarks", "", len(program.reading.remarks)),
        Loss("prints", "", int(prints and wanted.form != "detailed")),
        Loss("reduced", "", int(reduced.sum()) if wanted.iso is not None else 0),
        Loss("radii", "", int((words.radius_um > 0).sum()) if wanted.language != "4b" else 0),
    )


def _lost_offsets(toolpath: Toolpath, wanted: Wanted) -> tuple[Loss, ...]:
    compensation = toolpath.compensation
    if compensation is None or not compensation.side.any():
        return ()
    names = [name for name, side in zip(compensation.register, compensation.side.tolist(), strict=True) if side]
    if wanted.keeps and wanted.iso is not None:
        return ()
    return (Loss("offsets-left" if wanted.keeps else "offsets-worked-in", some(filter(None, names)), len(set(names))),)


def _changed_rows(path: Toolpath, draft: Draft, made: Written, wanted: Wanted) -> tuple[Loss, ...]:
    """Rows that became no block, more than one, or one of another kind."""
    blocks = np.bincount(made.row, minlength=len(draft))
    is_jump = draft.curves.kind == CurveKind.JUMP
    first = max(len(path) - len(draft), 0)
    ran = is_jump[max(len(draft) - len(path), 0) :]
    rapids = is_jump & ~draft.is_placed & (blocks > 0) & (not wanted.has_rapids and draft.words is None)
    return (
        Loss("first-rapids", "", first),
        Loss("rapids-back", "", int((path.is_jump[first:] & ~ran).sum())),
        Loss("rapids", "", int(rapids.sum())),
        Loss("nothing", "", int((blocks == 0).sum())),
        Loss("split", "", int((blocks > 1).sum())),
    )


_LAST_BLOCKS = 2
"""Blocks before its end beside which a path always runs."""


def closed_by_kerf(
    findings: Sequence[Finding], path: Toolpath, compensation: Compensation
) -> tuple[tuple[Finding, ...], float]:
    """Findings of open contours that a compensated path closes but for a kerf, and the widest of these gaps, µm.

    Where a contour begins and ends at a corner, its first block and its last one are moved aside in two directions. The
    wire, which cuts as far to each side as the path was moved, frees the piece all the same.
    """
    kerf_um = 2.0 * float(np.nanmax(np.abs(compensation.left_um)))
    gaps = [(finding, _gap_um(finding, path)) for finding, _ in telling(findings, OpenContour)]
    narrow = [(finding, gap_um) for finding, gap_um in gaps if gap_um <= kerf_um]
    return tuple(finding for finding, _ in narrow), max((gap_um for _, gap_um in narrow), default=0.0)


def _gap_um(finding: Finding, path: Toolpath) -> float:
    """How far the contour of a finding ends from the rest of itself."""
    first, last = int(finding.values["first"]) - 1, int(finding.values["last"]) - 1
    row = np.arange(first, last + 1 - _LAST_BLOCKS)
    if not len(row):
        return np.inf
    end = np.tile(path.end_um[last], (len(row), 1))
    return float(distance_to_curves(path, row, end[:, 0], end[:, 1])[0].min())


class Converted(NamedTuple):
    """A program that was written and proved.

    Attributes
    ----------
    data
        Bytes of its text; of two contours in 3B that of the lower one.
    program, checked
        What reading them gives, and what its check finds.
    off_um, bound_um
        How far it is from what it was written of, at most, and how far it may be.
    lost
        What it has not got of the program that it was converted of.
    told_by_itself
        Whether it is read the same without being told its dialect and unit.
    open_um
        How far apart the ends of a contour lie at most that only the kerf closes, as those of the compensated path do;
        0 where there is none.
    registers
        Values, µm, that the controller's table has to hold, by the names of their registers.
    ramp_ms
        Acceleration time that it sets, ms, as its shortest blocks ask for it; 0 where it sets none.
    stays_open
        Whether a check calls a contour open that is no more so than in its source. That of the source may be silent:
        where it compensates, leads are told from contours.
    upper_data
        Bytes of the text of the upper contour, in 3B; else None.
    """

    data: bytes
    program: Program
    checked: Checked
    off_um: float
    bound_um: float
    lost: tuple[Loss, ...]
    told_by_itself: bool
    open_um: float
    registers: Registers
    ramp_ms: int = 0
    stays_open: bool = False
    upper_data: bytes | None = None


class Refused(NamedTuple):
    """Why there is no conversion.

    Attributes
    ----------
    why
        Name of a text for people, ``convert.refused-…``.
    program
        The one that its findings are of: that to be converted, or the one that was written.
    findings
        What speaks against it.
    values
        What fills the text.
    """

    why: str
    program: Program
    findings: tuple[Finding, ...] = ()
    values: tuple[tuple[str, str], ...] = ()


def converted(program: Program, wanted: Wanted) -> Converted | Refused:
    """Convert a program; what has errors, or could not be read as a whole, is not converted.

    A contour that stays open has a path all the same: it is converted, and stays as open as it was.

    SettingsError where the dialect cannot say what the program needs.
    """
    checked = run_checks(program, Demands(may_stay_open=True))
    if _errors(checked):
        return Refused("source", program, _errors(checked))
    lost = _beside_the_path(program, checked, wanted)
    if lost is not None:
        return lost
    several = _several_offsets(program.toolpath, wanted)
    if several:
        return Refused("several-offsets", program, values=(("of", several),))
    path = _path(program, checked, wanted)
    is_offset = path is not program.toolpath or wanted.offset_um is not None
    draft = draft_for(path, wanted, carried_events(program, path, wanted) or (), is_offset=is_offset)
    if not len(draft):
        return Refused("nothing", program)
    return _word_for_word_or_not(
        program, path, draft, wanted, is_open=any(contour.is_open for contour in checked.contours)
    )


def _beside_the_path(program: Program, checked: Checked, wanted: Wanted) -> Refused | None:
    """Why a program is not converted whose path is not all that it asks for, or not all known; None where it is."""
    beside_text = ", ".join(program.reading.not_simulated.words)
    if beside_text:
        said = tuple(finding for finding, _ in telling(checked.findings, NotSimulated))
        return Refused("not-simulated", program, said, (("words", beside_text),))
    if program.toolpath.leans and not _keeps_lean(program, checked, wanted):
        return Refused("leans", program, tuple(found for found, _ in telling(checked.findings, Leans)))
    return None if checked.coverage.is_complete else Refused("incomplete", program)


def _keeps_lean(program: Program, checked: Checked, wanted: Wanted) -> bool:
    """Whether ISO can say the lean of a program: two contours, or angles of blocks that stay what they are."""
    if program.toolpath.upper is not None:
        return wanted.language in {"3b", "iso"}
    return wanted.iso is not None and (wanted.keeps or checked.compensation is None)


def _word_for_word_or_not(
    program: Program, path: Toolpath, draft: Draft, wanted: Wanted, *, is_open: bool
) -> Converted | Refused:
    """The written program; of its path, where its words mean another one to a PMAC card."""
    done = _proved(program, path, draft, wanted, is_open=is_open)
    if isinstance(done, Converted) or wanted.pmac is None or wanted.pmac.blocks is None:
        return done
    return _proved(program, path, draft, wanted._replace(pmac=wanted.pmac._replace(blocks=None)), is_open=is_open)


def _path(program: Program, checked: Checked, wanted: Wanted) -> Toolpath:
    """The path as programmed where compensation is kept, else with what the controller makes of it."""
    made = checked.compensation
    if wanted.keeps or made is None:
        return program.toolpath
    top = own_offsets(program, made).top
    if top is None:
        return made.program.toolpath
    both = matched_offsets(made.path, top.path)
    return replace(section_toolpath(made.program.toolpath, both.lower, both.source_row), upper=both.upper)


def _several_offsets(toolpath: Toolpath, wanted: Wanted) -> str:
    """The offsets of a program for people, mm, where there are more than the one that 4B leaves to the controller."""
    compensation = toolpath.compensation
    if compensation is None or wanted.language != "4b" or not wanted.keeps:
        return ""
    left = np.unique(compensation.left_um[compensation.side != 0])
    return some(f"{mm(each):+.3f} mm" for each in left.tolist()) if len(left) > 1 else ""


def _proved(program: Program, path: Toolpath, draft: Draft, wanted: Wanted, *, is_open: bool) -> Converted | Refused:
    """The written program, or what speaks against it; its contours may be open where one of the source is."""
    made = written(draft, wanted)
    data = made.text.encode()
    upper_data = made.upper.encode() if made.upper is not None else None
    choices = read_with(draft, wanted)
    try:
        back = load_program(data, f"{program.name} → {wanted.language}", choices)
        if upper_data is not None:
            back = paired(back, load_program(upper_data, back.name, choices))
    except ProgramError as error:
        return Refused("result", program, (error.finding,))
    checked = run_checks(back, Demands(may_stay_open=is_open))
    compensation, open_um = program.toolpath.compensation, 0.0
    closed: tuple[Finding, ...] = ()
    if compensation is not None and not wanted.keeps:
        closed, open_um = closed_by_kerf(checked.findings, back.toolpath, compensation)
    wrong = tuple(finding for finding in _errors(checked) if finding not in closed)
    if wrong:
        return Refused("result", back, wrong)
    proven = proof(draft, made, back.toolpath)
    if proven.differs:
        return Refused("differs", back, values=(("what", f"convert.differs-{proven.differs}"),))
    bound_um = wanted.bound_for_um(draft)
    if proven.off_um > bound_um:
        return Refused("off", back, values=(("off", f"{proven.off_um:.3f}"), ("bound", f"{bound_um:g}")))
    alone = wanted.iso is None or _is_told_by_itself(data, draft, made, wanted, choices)
    lost = losses(program, path, draft, made, wanted)
    stays_open = not closed and _is_called_open(back, checked)
    return Converted(
        data,
        back,
        checked,
        proven.off_um,
        bound_um,
        lost,
        alone,
        open_um,
        choices.registers,
        made.ramp_ms,
        stays_open,
        upper_data,
    )


def _is_called_open(program: Program, checked: Checked) -> bool:
    """Whether a check that lets no contour stay open calls one so; `checked` lets them."""
    if not any(contour.is_open for contour in checked.contours):
        return False
    return any(telling(run_checks(program, Demands()).findings, OpenContour))


def _is_told_by_itself(data: bytes, draft: Draft, made: Written, wanted: Wanted, choices: Choices) -> bool:
    """Whether the text alone tells how it is to be read."""
    alone = proof(draft, made, load_program(data, "alone", Choices(registers=choices.registers)).toolpath)
    return alone == Proof(alone.off_um) and alone.off_um <= wanted.bound_for_um(draft)


def _errors(checked: Checked) -> tuple[Finding, ...]:
    return tuple(finding for finding in checked.findings if finding.severity is Severity.ERROR)
