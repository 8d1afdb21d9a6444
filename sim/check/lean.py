"""How a program is to lean, before anything moves: by its own words, by what is told beside it, or by two contours."""

from itertools import zip_longest
from typing import NamedTuple

import numpy as np

from controller.taper.tilted import Lean, TiltedPath, figure_lean, tilted, told_lean
from controller.taper.two_contours import between_contours, matched_offsets, matched_rows
from parser.controller_words import Taper
from parser.dialect.reader import Choices, at_block
from parser.findings.codes import Severity
from parser.findings.errors import ProgramError, SettingsError
from parser.geometry.curves import Floats
from parser.program import Program, load_program, paired, upper_program
from sim.check.compensation.check import compensation_of, own_compensation
from sim.check.offset import Offsetting
from sim.setup.machine.guides import Guides
from sim.setup.part import Offset
from sim.setup.taper import TaperSettings, UpperProgram, heights_of, refuse_one_height


class LeanDemands(NamedTuple):
    """What is known of the lean beside a program: what is told of it, the guides, and the height of the work, mm."""

    taper: TaperSettings
    guides: Guides
    thickness_mm: float


def with_upper(program: Program, taper: TaperSettings | None) -> Program:
    """The program with the upper contour that is told beside it; as it is where none is.

    ProgramError (3B705) where their blocks do not match; SettingsError where the upper one is no program or has a wrong
    block, and where one of them leans by itself.
    """
    if taper is None or taper.upper is None:
        return program
    upper = _upper_read(taper.upper, program.choices)
    for each in (program, upper):
        if each.toolpath.leans:
            raise SettingsError("taper-twice", name=each.name)
    return paired(program, upper)


def _upper_read(file: UpperProgram, choices: Choices) -> Program:
    """The program of an upper contour. SettingsError, which names its file, where a block of it cannot be run."""
    try:
        upper = load_program(file.data, file.name, choices)
    except ProgramError as error:
        raise SettingsError("upper-is-no-program", name=file.name, why=error.in_both()) from None
    wrong = next((found for found in upper.findings if found.severity is Severity.ERROR), None)
    if wrong is not None:
        why = ProgramError(wrong).in_both()
        raise SettingsError("upper-is-wrong", name=file.name, line=wrong.line, code=wrong.code, why=why)
    return upper


class Offsets(NamedTuple):
    """What an offset made of a program, and of its upper contour; None where there is no such thing."""

    plane: Offsetting | None
    top: Offsetting | None


def own_offsets(program: Program, plane: Offsetting | None) -> Offsets:
    """What a program's own compensation made of it, `plane`, with what it makes of its upper contour."""
    compensation = compensation_of(program.toolpath)
    if plane is None or compensation is None or program.toolpath.upper is None:
        return Offsets(plane, None)
    upper = upper_program(program)
    return Offsets(plane, own_compensation(upper, compensation, np.ones(len(upper.toolpath), dtype=np.bool_)).made)


def tilted_path(drawn: Program, offsets: Offsets, demands: LeanDemands) -> TiltedPath | None:
    """The way of the wire of a program; None where it is upright.

    SettingsError where program and settings both tell of the lean, where the program plane is outside of the work, and
    where two contours lie at one height; ProgramError (3B705) where the offsets of two contours run along them in
    different rounds.
    """
    taper, contour, made = demands.taper, drawn.toolpath, offsets.plane
    angle_rad = taper.angle_rad or 0.0
    if contour.leans and angle_rad:
        raise SettingsError("taper-twice", name=drawn.name)
    if not contour.leans and not angle_rad:
        return None
    heights = heights_of(taper, demands.guides, demands.thickness_mm)
    toolpath = contour if made is None else made.program.toolpath
    if contour.upper is not None:
        refuse_one_height(taper.program_plane_um, heights.work_um)
        contours = matched_rows(contour, contour.upper)
        if made is not None and offsets.top is not None:
            _refuse_other_rounds(drawn, made, offsets.top)
            contours = matched_offsets(made.path, offsets.top.path)
        return between_contours(toolpath, contours, heights, (taper.program_plane_um, heights.work_um))
    if contour.taper is not None:
        return tilted(toolpath, told_lean(_as_run(contour.taper, made), toolpath), heights, taper.corner)
    whole = figure_lean(toolpath, angle_rad, int(taper.side))
    lean = Lean(whole.tangent * _directions(made, len(toolpath)), whole.tilts)
    return tilted(toolpath, lean, heights, taper.corner)


def leaning_offset(offset: Offset | None, taper: TaperSettings | None) -> Offset | None:
    """An offset as it is in the program plane, where all contours lean by T: D / cos T (EDM_NC, g24.cpp)."""
    angle_rad = None if taper is None else taper.angle_rad
    if not angle_rad or offset is None:
        return offset
    cos = float(np.cos(angle_rad))
    return offset._replace(passes=tuple(each._replace(by_um=each.by_um / cos) for each in offset.passes))


def _refuse_other_rounds(drawn: Program, plane: Offsetting, top: Offsetting) -> None:
    """ProgramError (3B705) where the offsets of two contours run along them in different rounds."""
    below, above = ([passed.round for passed in of.passed.rounds] for of in (plane, top))
    if below == above:
        return
    row = next((ours.begin for ours, theirs in zip_longest(below, above) if ours and ours != theirs), 0)
    n = len(drawn.toolpath)
    found = at_block(drawn.toolpath, drawn.lines, "3B705", row, what="pair-rounds", lower=n, upper=n)
    raise ProgramError(found, excerpt=drawn.excerpt(found.line))


def _directions(made: Offsetting | None, rows: int) -> Floats:
    """(n,) +1 on rows that run as they were drawn, −1 on those of passes that run back."""
    if made is None:
        return np.ones(rows)
    return np.where(made.passed.is_back[made.path.source_row], -1.0, 1.0)


def _as_run(taper: Taper, made: Offsetting | None) -> Taper:
    """The lean of a program along the rows of the path that runs."""
    if made is None:
        return taper
    source = made.path.source_row
    row, back = made.passed.row[source], made.passed.is_back[source]
    return Taper(np.where(back, -taper.side[row], taper.side[row]), taper.angle_rad[row])
