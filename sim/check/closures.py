"""Findings about contours: whether they close, exact and stepped, and which block may be why not."""

from dataclasses import dataclass

import numpy as np

from parser.dialect.mender import Suspect
from parser.dialect.reader import at_block
from parser.findings.findings import Fact, Finding, Value, WrongBlock, telling
from parser.geometry.curves import Ints
from parser.program import Program
from parser.shape.contours import CLOSED_WITHIN_UM, Contour
from parser.shape.loops import end_in_waste

STEPPED_CLOSURE_UM = 12.0
"""A sound arc may end up to 9.9 µm off when stepped (sim/check/count_axes.py)."""
STEPPED_CLOSURE_UM_PER_ROOT_ARC = 6.0
"""Arcs end about 2 µm off, each in its own direction, so the sum of many grows as the root of their number. Three times
that does not happen by chance."""

MOST_SUSPECTED = 50
"""Contours of a program in which a broken block is looked for. If more stay open, the cause is no slip of a digit."""


@dataclass(frozen=True, slots=True)
class OpenContour(Fact):
    """The contour whose first block is `first` does not close."""

    first: int


@dataclass(frozen=True, slots=True)
class Suspected(Fact):
    """The contour whose first block is `first` would close with a field of this block written otherwise.

    Each of the `suspects` alone is enough. `is_proved` tells that there is but one, and that it explains more.
    """

    first: int
    suspects: tuple[Suspect, ...]
    is_proved: bool = False


def contour_findings(
    program: Program, contours: tuple[Contour, ...], rows: Ints, known: tuple[Finding, ...], *, may_stay_open: bool
) -> list[Finding]:
    """Open contours (3B301) with their suspects (3B304) unless they may stay open; poor stepped closure (3B302).

    `rows` (n,) is each row's contour. A contour with a closed loop may lead out elsewhere than it led in (3B311). A
    block that is `known` to be wrong explains its contour: then no other block is suspected, and the stepped closure is
    not named. Of the contours that do not close, the first `MOST_SUSPECTED` get suspects. Among them are contours that
    only run forward: a triangle with a wrong quadrant does so too, and a parting cut hardly ever has a block that would
    close it.
    """
    guilty = np.sort(np.array([finding.block for finding, _ in telling(known, WrongBlock)], dtype=np.int64))
    found: list[Finding] = []
    suspected = 0
    unclosed = [contour for contour in contours if contour.is_open and not may_stay_open]
    left = _left_elsewhere(program, rows, unclosed)
    for contour in contours:
        low, high = np.searchsorted(guilty, [contour.first, contour.last + 1])
        explained = bool(low < high)
        if contour.first in left:
            found += [_lead_out(program, contour, block) for block in (contour.first, contour.last)]
            continue
        gap, limit = contour.closure_stepped_um, stepped_limit_um(contour)
        if contour.is_open and not may_stay_open:
            found.append(_open(program, contour))
        elif (
            program.toolpath.words is not None  # else steps are ours alone, and no word can be wrong
            and contour.closure_exact_um <= contour.tolerance_um
            and gap - contour.closure_exact_um > limit
            and not explained
        ):
            values = _ends_of(contour) | {"gap": gap, "limit": limit}
            found.append(at_block(program.toolpath, program.lines, "3B302", contour.last - 1, **values))
        may_close = contour.is_open or contour.last - contour.first > 1  # one line or two are no figure
        if may_close and not (contour.returns or may_stay_open) and suspected < MOST_SUSPECTED:
            suspected += 1
            found += _suspects(program, contour, guilty[low:high])
    return found


def _left_elsewhere(program: Program, rows: Ints, contours: list[Contour]) -> set[int]:
    """First blocks of those open contours whose loop is closed, and whose lead-out ends in the waste.

    A contour that ends within some µm of its start was to end there, and is not among them.
    """
    far = (contour.first for contour in contours if contour.closure_exact_um > CLOSED_WITHIN_UM)
    first = np.fromiter(far, dtype=np.int64)
    if not len(first):
        return set()
    number = rows[first - 1]
    return set(first[np.isin(number, end_in_waste(program.toolpath, rows, number))].tolist())


def _lead_out(program: Program, contour: Contour, block: int) -> Finding:
    values = _ends_of(contour) | {"gap": contour.closure_exact_um}
    return at_block(program.toolpath, program.lines, "3B311", block - 1, **values)


def stepped_limit_um(contour: Contour) -> float:
    """Closure in µm within which the steps of a sound contour end."""
    return float(STEPPED_CLOSURE_UM + STEPPED_CLOSURE_UM_PER_ROOT_ARC * contour.arcs**0.5)


def _open(program: Program, contour: Contour) -> Finding:
    values = _ends_of(contour) | {"gap": contour.closure_exact_um}
    found = at_block(program.toolpath, program.lines, "3B301", contour.last - 1, **values)
    return found.with_fact(OpenContour(contour.first))


def _ends_of(contour: Contour) -> dict[str, Value]:
    return {"first": contour.first, "last": contour.last}


def _suspects(program: Program, contour: Contour, guilty: Ints) -> list[Finding]:
    """Notes at blocks that would close the contour if one of their fields were written otherwise.

    Where some of its blocks are known to be `guilty`, of these alone.
    """
    if program.mender is None:
        return []
    found: dict[int, list[Suspect]] = {}
    for suspect in program.mender.suspects(program.toolpath, contour.first - 1, contour.last):
        if not len(guilty) or suspect.row + 1 in guilty:
            found.setdefault(suspect.row, []).append(suspect)
    return [suspect_finding(program, contour.first, contour.last, tuple(of)) for of in found.values()]


def suspect_finding(program: Program, first: int, last: int, suspects: tuple[Suspect, ...]) -> Finding:
    """Finding 3B304 at a block with which the contour of the blocks from `first` to `last` closes in these ways."""
    first_suspect, others = (
        suspects[0],
        [] if program.mender is None else [program.mender.mends_text((s.mend,)) for s in suspects[1:]],
    )
    return at_block(
        program.toolpath,
        program.lines,
        "3B304",
        first_suspect.row,
        first_suspect.field,
        first=first,
        last=last,
        field=first_suspect.field.term,
        written=first_suspect.written,
        other=first_suspect.other,
        others=" / ".join(others),
    ).with_fact(Suspected(first, suspects))
