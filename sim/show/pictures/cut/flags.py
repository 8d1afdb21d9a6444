"""Findings as flags: a marker where each is, with its code, and those of one place as one."""

from collections.abc import Sequence
from itertools import product
from typing import Final, NamedTuple

import numpy as np

from parser.findings.codes import Severity
from parser.findings.findings import Count, Finding, counted
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints
from parser.toolpath import Toolpath
from parser.units import from_mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box, box_around
from sim.show.draw.paints import Paint
from sim.show.pictures.cut.subject import Board

SEVERITY_PAINTS: Final = {Severity.ERROR: Paint.ERROR, Severity.WARNING: Paint.WARNING, Severity.NOTE: Paint.GREY}
_WORST_FIRST: Final = tuple(Severity)
_SHARES: Final = (0.5, 0.35, 0.65, 0.2, 0.8)
_MOST_CODES: Final = 2
_MOST_TEXTS: Final = 40


class Flag(NamedTuple):
    """Findings of one place, µm on the part: how many there are of each code, the worst first."""

    place_um: Floats
    counts: tuple[Count, ...]

    @property
    def severity(self) -> Severity:
        """That of the worst."""
        return self.counts[0].severity

    @property
    def text(self) -> str:
        """Codes with their counts, such as ``3B305 ×4``."""
        texts = [count.text for count in self.counts]
        more = len(texts) - _MOST_CODES
        return ", ".join(texts[:_MOST_CODES]) + (f" +{more}" if more > 0 else "")


def flags_of(toolpath: Toolpath, findings: Sequence[Finding], apart_um: float) -> list[Flag]:
    """Flags no nearer to each other than a distance; findings that have no place on the path are left out."""
    found = sorted(findings, key=lambda finding: _WORST_FIRST.index(finding.severity))
    place = places_um(toolpath, found, apart_um)
    placed = np.flatnonzero(np.isfinite(place[:, 0]))
    at = placed[_gathered(place[placed], apart_um)]
    groups: dict[int, list[Finding]] = {}
    for each, first in zip(placed.tolist(), at.tolist(), strict=True):
        groups.setdefault(first, []).append(found[each])
    return [Flag(place[first], counted(group)) for first, group in groups.items()]


def places_um(toolpath: Toolpath, findings: Sequence[Finding], off_um: float) -> Floats:
    """Where findings are, (n, 2): the places that they name, else those on their blocks; NaN where they have neither.

    On a block it is the middle; where the path starts or ends within `off_um` of that, another place on the block.
    """
    block = np.array([finding.block for finding in findings], dtype=np.int64)
    order = np.argsort(toolpath.source.block, kind="stable")  # passes that run back have the blocks in falling order
    first, past = (np.searchsorted(toolpath.source.block[order], number) for number in (block, block + 1))
    known = np.flatnonzero((block > 0) & (first < past))
    place = np.full((len(findings), 2), np.nan)
    place[known] = _on_blocks(toolpath, order[((first + past - 1) // 2)[known]], off_um)
    for at, finding in enumerate(findings):
        if finding.place_mm is not None:
            place[at] = from_mm(np.array(finding.place_mm))
    return place


def _on_blocks(toolpath: Toolpath, row: Ints, off_um: float) -> Floats:
    """Places (m, 2) on the rows (m,): at the first of `_SHARES` that lies `off_um` from start and end of the path."""
    share = np.tile(_SHARES, len(row))
    on = places(toolpath, np.repeat(row, len(_SHARES)), share).reshape(len(row), len(_SHARES), 2)
    ends = (toolpath.start_um[0], toolpath.end_um[-1])
    free = np.all([np.hypot(*np.moveaxis(on - end, -1, 0)) >= off_um for end in ends], axis=0)
    chosen: Floats = on[np.arange(len(row)), np.argmax(free, axis=1)]
    return chosen


def _gathered(place: Floats, apart: float) -> Ints:
    """For each of n places the index of the one that stands for it: itself, or an earlier one nearer than `apart`."""
    # All places in one cell of a grid count as one: only as many are compared as fit on a page.
    cell, first, of = np.unique(np.floor(place / apart), axis=0, return_index=True, return_inverse=True)
    stands = np.empty(len(cell), dtype=np.int64)
    kept_numbers: list[int] = []
    for group in np.argsort(first).tolist():
        at = int(first[group])
        away = np.hypot(*(place[kept_numbers] - place[at]).T)
        near = np.flatnonzero(away < apart)
        stands[group] = kept_numbers[int(near[0])] if len(near) else at
        kept_numbers += [] if len(near) else [at]
    found: Ints = stands[of.reshape(-1)]
    return found


def flag_reach(unit: float) -> float:
    """How far apart flags stand, px."""
    return 2.2 * style.FLAG * unit


def draw_flags(board: Board, flags: Sequence[Flag], *, codes: bool) -> None:
    """Draw the flags that lie in the plot, with their codes where there is room."""
    page = board.page
    reach = 2 * style.FLAG * page.unit
    centers = [page.view.to_px(flag.place_um) for flag in flags]
    drawn = [
        (flag, center)
        for flag, center in zip(flags, centers, strict=True)
        if page.plot.holds(box_around(center, 0.0, 0.0))
    ]
    for _, center in drawn:
        board.room.block(box_around(center, reach, reach))
    for flag, center in drawn[:_MOST_TEXTS] if codes else ():
        _write(board, flag, center)
    for flag, center in reversed(drawn):
        draw_flag(board.canvas, center, flag.severity, page.unit)


def draw_flag(canvas: Canvas, center: Floats, severity: Severity, unit: float) -> None:
    """Draw a marker: a diamond for an error, a triangle for a warning, a disc for a note."""
    reach, paint = style.FLAG * unit, SEVERITY_PAINTS[severity]
    for size, colour in ((reach, Paint.PAGE), (reach - 2.0 * unit, paint)):
        if severity is Severity.NOTE:
            canvas.disc(center, 0.72 * size, colour)
        else:
            corners = 4 if severity is Severity.ERROR else 3
            angle = 2.0 * np.pi * np.arange(corners) / corners
            canvas.polygon(center + size * np.stack([np.sin(angle), -np.cos(angle)], axis=1), colour)
    middle = (float(center[0]), float(center[1]))
    canvas.text(middle, "i" if severity is Severity.NOTE else "!", 0.95 * reach, Paint.PAGE, align=0.5)


def _write(board: Board, flag: Flag, center: Floats) -> None:
    canvas, unit = board.canvas, board.page.unit
    size = style.NUMBER * unit
    wide, tall = canvas.text_width(flag.text, size) + 2 * style.NUMBER_INSET * unit, 1.25 * size
    box = board.room.take(_round(center, (wide, tall), style.FLAG * unit))
    if box:
        canvas.box(box, Paint.PAGE, SEVERITY_PAINTS[flag.severity], unit)
        middle = (box.left + box.right) / 2, (box.top + box.bottom) / 2
        canvas.text(middle, flag.text, size, SEVERITY_PAINTS[flag.severity], align=0.5)


def _round(center: Floats, size: tuple[float, float], reach: float) -> list[Box]:
    """Boxes of a size on all sides of a marker, the right side first."""
    sides = ((1, 0), (-1, 0), (0, -1), (0, 1), (1, -1), (1, 1), (-1, -1), (-1, 1))
    away = np.array(size) / 2 + reach
    return [
        box_around(center + np.array(side) * (away + more * reach), *size) for more, side in product((0, 1.5), sides)
    ]
