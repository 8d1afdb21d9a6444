"""Marks on the path: starts, pauses, ends, which way it runs; and findings as flags.

Numbers of the blocks beside the path: none covers another, and where there are many, some stand for all.

Findings as flags: a marker where each is, with its code, and those of one place as one.
"""

from collections.abc import Sequence
from itertools import product
from typing import Final, NamedTuple

import numpy as np

from parser.findings.codes import Severity
from parser.findings.findings import Count, Finding, counted, telling
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints
from parser.toolpath import Stop, Toolpath
from parser.units import from_mm
from sim.check.closures import OpenContour
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import along
from sim.show.draw.layout import Anchors, Box, View, box_around, number_stride, place_numbers
from sim.show.draw.letters import text_width
from sim.show.draw.style import Paint
from sim.show.pictures.cut.sizes import length_text
from sim.show.pictures.cut.subject import Board
from sim.show.texts import Words

NUMBERS_AT: Final = (0.5, 0.4, 0.6, 0.3, 0.7)
"""Where along a block its number may stand, best first."""


class Numbers(NamedTuple):
    """Every how manyth block shows its number, and whether all of these do."""

    stride: int
    complete: bool

    def text(self, say: Words) -> str:
        """What the numbers are, such as ``every 100th block number``."""
        key = f"cut.numbers_{self.stride}" if self.stride <= 2 else "cut.numbers"
        numbers = say(key, stride=self.stride)
        return numbers if self.complete else say("cut.numbers_fit", numbers=numbers)


def draw_numbers(board: Board, toolpath: Toolpath, kerf_px: float) -> Numbers:
    """Draw block numbers beside a kerf of a drawn width, as the listing has them."""
    canvas, page = board.canvas, board.page
    stride = number_stride(int(toolpath.source.block.max()))
    row = _rows(toolpath, stride)
    texts = [toolpath.source.names.of_row(at) for at in row.tolist()]
    sizes = np.array([number_size(text, page.unit) for text in texts]).reshape(-1, 2)
    anchors = [_anchors(page.view, toolpath, row, share) for share in NUMBERS_AT]
    gap = style.NUMBER_GAP * page.unit
    places = place_numbers(anchors, sizes, gap + min(kerf_px / 2, gap), board.room)
    for text, box in zip(texts, places, strict=True):
        if box:
            draw_number(canvas, box, text, page.unit)
    return Numbers(stride, all(places))


def draw_number(canvas: Canvas, box: Box, number: str, unit: float) -> None:
    """Draw a block number in its box."""
    canvas.box(box, Paint.PAGE, Paint.FRAME, unit)
    middle = ((box.left + box.right) / 2, (box.top + box.bottom) / 2)
    canvas.text(middle, number, style.NUMBER * unit, Paint.INK, align=0.5)


def number_size(number: str, unit: float) -> tuple[float, float]:
    """Width and height of the box of a block number, px."""
    text = text_width(number, style.NUMBER * unit)
    return text + 2 * style.NUMBER_INSET * unit, 1.25 * style.NUMBER * unit


def _rows(toolpath: Toolpath, stride: int) -> Ints:
    """The longest row of every `stride`-th block of the program, the longest of all first."""
    row = np.argsort(-toolpath.length_um, kind="stable")
    block = toolpath.source.block[row]
    first = np.sort(np.unique(block, return_index=True)[1])
    rows: Ints = row[first[block[first] % stride == 0]]
    return rows


def _anchors(view: View, toolpath: Toolpath, row: Ints, share: float) -> Anchors:
    points, heading = along(toolpath, row, np.full(len(row), share))
    ways: Floats = heading * (1.0, -1.0)
    return Anchors(view.to_px(points), np.stack([-ways[:, 1], ways[:, 0]], axis=1))


ARROW_AT: Final = 2 / 3
"""Past the middle, so that the arrows of a way out and back on one line stand apart."""

_MOST_PAUSES: Final = 60
_SAME_GAP_UM: Final = 1.0


def draw_ends(board: Board, toolpath: Toolpath) -> None:
    """Draw the hollow circle of the start and the cross of the end."""
    canvas, page = board.canvas, board.page
    start, end = page.view.to_px(np.stack([toolpath.start_um[0], toolpath.end_um[-1]]))
    reach = 2 * (style.CROSS + style.MARK_WIDTH) * page.unit
    for marker in (start, end):
        board.room.block(box_around(marker, reach, reach))
    draw_start(canvas, start, page.unit)
    draw_end(canvas, end, page.unit)


def draw_gaps(board: Board, toolpath: Toolpath, findings: Sequence[Finding]) -> None:
    """Draw how far contours that do not close end from their starts, with the lengths of the gaps."""
    canvas, unit = board.canvas, board.page.unit
    size = style.NUMBER * unit
    for gap in _gaps_um(toolpath, findings)[:_MOST_TEXTS]:
        ends = board.page.view.to_px(gap)
        canvas.dashed(ends, Paint.ERROR, style.MARK_WIDTH * unit, style.DASH * unit, style.DASH_GAP * unit)
        text = board.say("cut.gap", size=length_text(float(np.hypot(*(gap[1] - gap[0])))))
        wide = text_width(text, size) + 2 * style.NUMBER_INSET * unit
        box = board.room.take(_round(ends.mean(axis=0), (wide, 1.25 * size), (style.MARK + style.CROSS) * unit))
        if box:
            canvas.box(box, Paint.PAGE, Paint.PAGE, 0.0)
            canvas.text(((box.left + box.right) / 2, (box.top + box.bottom) / 2), text, size, Paint.ERROR, align=0.5)


def _gaps_um(toolpath: Toolpath, findings: Sequence[Finding]) -> list[Floats]:
    """Ends (2, 2) of the gaps of open contours: of these blocks as they run here, which an offset may have changed."""
    found = []
    for finding, _ in telling(findings, OpenContour):
        first, last, gap_um = (finding.values[key] for key in ("first", "last", "gap"))
        if isinstance(first, int) and isinstance(last, int) and isinstance(gap_um, float) and last <= len(toolpath):
            ends = np.stack([toolpath.end_um[last - 1], toolpath.start_um[first - 1]])
            found += [ends] if abs(float(np.hypot(*(ends[1] - ends[0]))) - gap_um) <= _SAME_GAP_UM else []
    return found


def draw_start(canvas: Canvas, center: Floats, unit: float) -> None:
    """Draw the hollow circle of a start at `center`, (2,) px."""
    canvas.ring(center, style.MARK * unit, Paint.START, style.MARK_WIDTH * unit)


def draw_end(canvas: Canvas, center: Floats, unit: float) -> None:
    """Draw the cross of an end at `center`, (2,) px."""
    arm = style.CROSS * unit * np.array([1.0, 1.0]) / np.sqrt(2)
    for mirror in ((1.0, 1.0), (1.0, -1.0)):
        canvas.polyline(np.stack([center - arm * mirror, center + arm * mirror]), Paint.END, style.MARK_WIDTH * unit)


def pauses(toolpath: Toolpath) -> list[Stop]:
    """Pauses between blocks, without the end."""
    return [stop for stop in toolpath.stops if stop.kind == "pause"]


def draw_pauses(board: Board, toolpath: Toolpath, *, numbers: bool) -> int:
    """Draw the two bars of each pause, beside the path where it stands, with the block that it follows; how many."""
    canvas, unit = board.canvas, board.page.unit
    corners = board.page.view.to_px(np.concatenate([toolpath.start_um[:1], toolpath.end_um]))
    drawn = 0
    for stop in pauses(toolpath)[:_MOST_PAUSES]:
        number = toolpath.source.names.at(stop.after) if stop.after and numbers else ""
        size = _pause_size(number, unit)
        corner = corners[min(stop.after, len(toolpath))]
        box = board.room.take(_boxes_beside(corner, size, unit))
        if box:
            drawn += 1
            nearest = np.clip(corner, [box.left, box.top], [box.right, box.bottom])
            canvas.polyline(np.stack([corner, nearest]), Paint.PAUSE, style.SIZE_WIDTH * unit)
            canvas.disc(corner, 2.5 * style.SIZE_WIDTH * unit, Paint.PAUSE)
            draw_pause(canvas, box, number, unit)
    return drawn


def draw_pause(canvas: Canvas, box: Box, number: str, unit: float) -> None:
    """Draw the bars of a pause in a box, and a number behind them."""
    canvas.box(box, Paint.PAGE, Paint.PAUSE, 1.5 * unit)
    side = style.PAUSE * unit
    middle, tall = (box.top + box.bottom) / 2, 0.22 * side
    for share in (0.36, 0.64):
        x = box.left + share * side
        canvas.polyline(np.array([[x, middle - tall], [x, middle + tall]]), Paint.PAUSE, 4.0 * unit)
    canvas.text((box.left + side, middle), number, style.NUMBER * unit, Paint.PAUSE)


def _pause_size(number: str, unit: float) -> tuple[float, float]:
    text = text_width(number, style.NUMBER * unit) + style.NUMBER_INSET * unit if number else 0.0
    return style.PAUSE * unit + text, style.PAUSE * unit


def _boxes_beside(corner: Floats, size: tuple[float, float], unit: float) -> list[Box]:
    """Boxes about a corner of the path, off its marks."""
    sides = ((1, -1), (-1, -1), (1, 1), (-1, 1), (0, -1), (0, 1), (1, 0), (-1, 0))
    ways = product((1.0, 2.2), sides)
    gap = style.MARK * unit
    return [box_around(corner + np.array(side) * (np.array(size) / 2 + more * gap), *size) for more, side in ways]


def draw_arrows(board: Board, toolpath: Toolpath) -> None:
    """Draw arrow heads along the path where they are not in the way."""
    page = board.page
    size = style.ARROW * page.unit
    row = _arrow_rows(toolpath.length_um * page.view.px_per_um, page.unit)
    points, heading = along(toolpath, row, np.full(len(row), ARROW_AT))
    centers, ways = page.view.to_px(points), heading * (1.0, -1.0)
    for center, ahead, jump in zip(centers, ways, toolpath.is_jump[row], strict=True):
        if board.room.take([box_around(center, size, size)]):
            board.canvas.arrow(center + ahead * size / 2, ahead, size, Paint.JUMP if jump else Paint.IDEAL)


def _arrow_rows(length_px: Floats, unit: float) -> Ints:
    """Every long block, and one short block in each stretch of travel."""
    travel = np.cumsum(length_px)
    spacing = max(style.ARROW_SPACING * unit, float(travel[-1]) / 60)
    passed = np.diff(np.floor(travel / spacing), prepend=0.0) > 0
    return np.flatnonzero(passed | (length_px >= style.ARROW_BLOCK_MIN * unit))


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
    wide, tall = text_width(flag.text, size) + 2 * style.NUMBER_INSET * unit, 1.25 * size
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
