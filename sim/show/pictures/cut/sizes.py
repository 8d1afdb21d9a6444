"""Sizes of what is kept: which ones a picture gives, and how they are drawn.

A picture gives width and height of what is kept, and its largest radii, as they are meant to be. Where a cut is off its
drawing it gives a size as cut, and beside it the one that is drawn.

They are drawn as on a drawing: lines with arrows outside of the part, and leaders to radii.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.shape.contours import contour_rows
from parser.shape.loops import Loops, find_loops
from parser.toolpath import Toolpath
from parser.units import mm_text
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import along, bounds_um, flatten
from sim.show.draw.layout import Box, Margins, Page, box_around
from sim.show.draw.letters import text_width
from sim.show.draw.style import Paint
from sim.show.pictures.cut.subject import Board, Cut
from sim.show.texts import Words

if TYPE_CHECKING:  # of a path none are known, and their rooms take long to load
    from sim.cut.pieces.pieces import Pieces
    from sim.cut.sizes import Sizes
    from sim.measure.compare.result import OffSize, OffSizes


LEAST_SWEEP_RAD: Final = np.radians(30.0)
_WHOLE_RAD: Final = np.radians(359.0)
_SAME_UM: Final = 10.0  # centres this near are one
_ORIENTATION_UM: Final = 10.0  # chords that tell which way a loop turns


class Round(NamedTuple):
    """Arcs of one nominal radius µm: their rows, how many circles or corners they are, and whether whole circles.

    `off` has the radius of the one that is farthest off the drawing; None where none is off.
    """

    radius_um: float
    rows: Ints
    number: int
    whole: bool
    off: "OffSize | None" = None

    def text(self, say: Words) -> str:
        """A size such as ``2× Ø 10`` or ``R 2.5``; one that is off such as ``R 2.413, drawn 2.5``."""
        times = 2.0 if self.whole else 1.0
        size = length_text(times * self.radius_um)
        if self.off is not None:
            cut, drawn = (length_text(times * radius_um) for radius_um in self.off)
            size = say("cut.off_size", size=cut, drawn=drawn)
        sign = "Ø" if self.whole else "R"
        return f"{sign} {size}" if self.number == 1 else f"{self.number}× {sign} {size}"


class CutSizes(NamedTuple):
    """Sizes to be shown: a box (2, 2) µm, None where there is none, and radii on arcs of `path`, the largest first.

    There is no box where nothing closes, or where all of it goes into the kerf. With `of_path` the box is that of the
    path: nothing tells on which side of it the part lies. Width and height are `off` the drawing, None where they are
    not.
    """

    box_um: Floats | None
    rounds: tuple[Round, ...]
    path: Toolpath
    of_path: bool
    off: "tuple[OffSize | None, ...]" = (None, None)


class _Arcs(NamedTuple):
    """Arcs (k,) by their rows, with the radii that are meant."""

    row: Ints
    radius_um: Floats


def length_text(length_um: float) -> str:
    """A length in mm with three decimals at most, such as ``12.5``."""
    return mm_text(length_um).rstrip("0").rstrip(".")


def sizes_of_cut(cut: Cut) -> CutSizes:
    """Sizes of what a cut keeps: those that were worked out, else those of the path, the offset taken off or added."""
    if cut.sizes is not None and cut.sizes.boxes:
        return _measured(cut.toolpath, cut.sizes, cut.off_sizes)
    if cut.contour is not None:
        return _of_path(cut.contour, 0.0, cut.pieces)
    return _of_path(cut.toolpath, cut.kerf_um / 2, cut.pieces)


def _measured(toolpath: Toolpath, sizes: "Sizes", off: "OffSizes | None") -> CutSizes:
    areas = [box.nominal_um.x * box.nominal_um.y for box in sizes.boxes]
    largest = int(np.argmax(areas))
    box = sizes.boxes[largest]
    half, centre = np.array(box.nominal_um) / 2, np.array(box.center_um)
    row = np.array([each.block - 1 for each in sizes.radii], dtype=np.int64)
    arcs = _Arcs(row, np.array([each.nominal_um for each in sizes.radii], dtype=np.float64))
    measured = CutSizes(np.stack([centre - half, centre + half]), _rounds(toolpath, arcs), toolpath, of_path=False)
    if off is None:
        return measured
    of_row: dict[int, list[OffSize]] = {}
    for at, radius in zip(row.tolist(), off.radii, strict=True):
        of_row.setdefault(at, []).extend([radius] if radius else [])
    rounds = [
        each._replace(off=_worst(size for at in each.rows.tolist() for size in of_row[at])) for each in measured.rounds
    ]
    return measured._replace(rounds=tuple(rounds), off=off.widths[largest])


def _worst(sizes: "Iterable[OffSize]") -> "OffSize | None":
    return max(sizes, key=lambda size: abs(size.cut_um - size.drawn_um), default=None)


def _of_path(toolpath: Toolpath, offset_um: float, pieces: "Pieces | None") -> CutSizes:
    contours = contour_rows(toolpath)
    loops = find_loops(toolpath, contours, np.arange(contours.max(initial=-1) + 1))
    if not len(loops.contour):
        return CutSizes(None, (), toolpath, of_path=False)
    loops = loops._replace(part_side=_sides(toolpath, loops, pieces))
    boxes = [bounds_um(toolpath.picked(slice(*each))) for each in zip(loops.first, loops.last + 1, strict=True)]
    largest = int(np.argmax([np.prod(high - low) for low, high in boxes]))
    side = int(loops.part_side[largest])
    grow = -side * _turns(toolpath, loops, largest) * offset_um
    box = boxes[largest] + grow * np.array([[-1.0], [1.0]])
    of_path = side == 0 and offset_um > 0.0
    rounds = _rounds(toolpath, _arcs(toolpath, loops, offset_um))
    return CutSizes(box if (box[1] > box[0]).all() else None, rounds, toolpath, of_path)


def _sides(toolpath: Toolpath, loops: Loops, pieces: "Pieces | None") -> Ints:
    """Side (k,) that the part lies on: the lead-in tells; without one, the kind of the largest piece it frees."""
    freed = sorted(pieces.freed, key=lambda piece: piece.area_mm2) if pieces else []
    side, kinds = loops.part_side.copy(), {piece.freed.contour - 1: piece.kind for piece in freed}
    for at in np.flatnonzero(side == 0).tolist():
        kind = kinds.get(int(loops.contour[at]))
        if kind is not None:
            side[at] = _turns(toolpath, loops, at) * (1 if kind == "part" else -1)
    return side


def _turns(toolpath: Toolpath, loops: Loops, at: int) -> int:
    """Which way a loop runs: +1 counter-clockwise, −1 clockwise."""
    rows = slice(int(loops.first[at]), int(loops.last[at]) + 1)
    x, y = (flatten(toolpath.picked(rows), _ORIENTATION_UM)[0] - toolpath.start_um[rows][0]).T
    return 1 if x @ np.roll(y, -1) > y @ np.roll(x, -1) else -1


def _arcs(toolpath: Toolpath, loops: Loops, offset_um: float) -> _Arcs:
    """Arcs of loops of which it is known on which side the part lies; of all loops where there is no offset."""
    side = np.zeros(len(toolpath) + 1, dtype=np.int64)
    known = (loops.part_side != 0) | (offset_um == 0.0)
    np.add.at(side, loops.first[known], np.where(loops.part_side, loops.part_side, 1)[known])
    np.add.at(side, loops.last[known] + 1, -np.where(loops.part_side, loops.part_side, 1)[known])
    side = np.cumsum(side)[:-1]
    boss = np.sign(toolpath.sweep_rad) == side
    radius = toolpath.radius_um + np.where(boss, -offset_um, offset_um)
    row = np.flatnonzero(toolpath.is_arc & (side != 0) & (np.nan_to_num(radius) > 0.0))
    return _Arcs(row, radius[row])


def _rounds(toolpath: Toolpath, arcs: _Arcs) -> tuple[Round, ...]:
    """Arcs by their radii, those of a circle together; the largest first."""
    radius = np.rint(arcs.radius_um)
    circle = np.column_stack([np.rint(toolpath.center_um[arcs.row] / _SAME_UM), radius])
    _, of = np.unique(circle, axis=0, return_inverse=True)
    of = of.reshape(-1)
    sweep = np.bincount(of, np.abs(toolpath.sweep_rad[arcs.row]))
    whole = (sweep >= _WHOLE_RAD)[of]
    wanted = whole | (np.abs(toolpath.sweep_rad[arcs.row]) >= LEAST_SWEEP_RAD)
    found = []
    for value, is_whole in sorted(set(zip(radius[wanted].tolist(), whole[wanted].tolist(), strict=True)), reverse=True):
        mine = wanted & (radius == value) & (whole == is_whole)
        first = int(np.flatnonzero(mine)[0])
        exact = float(arcs.radius_um[first])
        found.append(Round(exact, arcs.row[mine], len(np.unique(of[mine])), is_whole))
    return tuple(found)


MOST_ROUNDS: Final = 6
_ROUND_AT: Final = (0.62, 0.38, 0.75, 0.25, 0.5, 0.87, 0.13)
_MOST_ARCS: Final = 5  # of one radius, that may bear it
_LEAST_ROUND: Final = 14.0  # px; smaller ones are not seen as round


class Extents(NamedTuple):
    """Lines of width and height: the box that they measure and that of the path, both (2, 2) µm, and their sides.

    `sides` (2,) is 0 where the height stands to the left and the width below, 1 to the right and above.
    """

    box_um: Floats
    path_um: Floats
    sides: tuple[int, int]

    def margins(self) -> Margins:
        """Free border inside the frame, with room for the lines."""
        left, right = (style.PAD, style.SIZE_PAD)[:: 1 if self.sides[0] else -1]
        bottom, top = (style.PAD, style.SIZE_PAD)[:: 1 if self.sides[1] else -1]
        return Margins(left, top, right, bottom)

    def lines(self, page: Page) -> tuple[Floats, Floats]:
        """The lines (2, 2) px, each from the lower to the higher coordinate."""
        (left, bottom), (right, top) = page.view.to_px(self.box_um)
        ends = page.view.to_px(self.path_um)
        offset, level = float(ends[self.sides[0], 0]), float(ends[self.sides[1], 1])
        offset += (2 * self.sides[0] - 1) * style.SIZE_AWAY * page.unit
        level -= (2 * self.sides[1] - 1) * style.SIZE_AWAY * page.unit
        return np.array([[left, level], [right, level]]), np.array([[offset, bottom], [offset, top]])


def extents_of(sizes: CutSizes, path_um: Floats) -> Extents | None:
    """Lines outside the whole path, each on the side that the measured box is nearer to; None where there is no box."""
    if sizes.box_um is None:
        return None
    gap = np.abs(path_um - sizes.box_um)
    right, above = bool(gap[1, 0] <= 2.0 * gap[0, 0]), bool(2.0 * gap[1, 1] < gap[0, 1])
    return Extents(sizes.box_um, path_um, (int(right), int(above)))


def draw_extents(board: Board, sizes: CutSizes, extents: Extents) -> None:
    """Draw width and height of what is kept."""
    page = board.page
    corner = page.view.to_px(extents.box_um)[extents.sides, (0, 1)]
    for axis, line in enumerate(extents.lines(page)):
        length = length_text(float(extents.box_um[1, axis] - extents.box_um[0, axis]))
        texts = [board.say("cut.path_size", size=length) if sizes.of_path else length]
        off = sizes.off[axis]
        if off is not None:
            texts = _off_texts(off, board.say, in_one=axis == 0)
        _draw_limits(board.canvas, page.unit, line, float(corner[1 - axis]))
        board.room.block(_draw_size(board.canvas, page.unit, line, texts, Paint.ERROR if off else Paint.SIZE))


def _off_texts(off: "OffSize", say: Words, *, in_one: bool) -> list[str]:
    """A size that is off in one line, or in two beside a line that stands upright, where one would be too wide."""
    cut, drawn = map(length_text, off)
    return [say("cut.off_size", size=cut, drawn=drawn)] if in_one else [cut, say("cut.drawn_size", drawn=drawn)]


def _draw_limits(canvas: Canvas, unit: float, line: Floats, from_px: float) -> None:
    """Draw the two lines that lead from the part to the line of a size."""
    across = 1 if line[0, 1] == line[1, 1] else 0
    gap = np.sign(line[0, across] - from_px) * style.SIZE_GAP * unit
    for end in line:
        limit = np.stack([end, end])
        limit[0, across] = from_px + gap
        limit[1, across] += gap
        canvas.polyline(limit, Paint.SIZE, 0.7 * style.SIZE_WIDTH * unit)


def _draw_size(canvas: Canvas, unit: float, line: Floats, texts: Sequence[str], paint: Paint) -> Box:
    """Draw a line with arrows at both ends and texts, one below the other, in its middle; the box of these.

    They stand beyond the line where it is short.
    """
    size, arrow = style.SIZE * unit, style.SIZE_ARROW * unit
    length = float(np.abs(line[1] - line[0]).max())
    ahead = (line[1] - line[0]) / length
    wide = max(text_width(text, size) for text in texts) + size / 2
    high = 1.2 * size * len(texts)
    needed = float(np.abs(ahead) @ (wide, high))
    fits = length >= needed + 2.6 * arrow
    half = ahead * needed / 2
    middle = line.mean(axis=0) if fits else line[1] + ahead * 2.0 * arrow + half
    inner = [[line[0], middle - half], [middle + half, line[1]]]
    outer = [line, [line[0], line[0] - 1.9 * arrow * ahead], [line[1], line[1] + 1.9 * arrow * ahead]]
    for stroke in inner if fits else outer:
        canvas.polyline(np.asarray(stroke), paint, style.SIZE_WIDTH * unit)
    for end, way in ((line[0], -ahead), (line[1], ahead)):
        canvas.arrow(end, way if fits else -way, arrow, paint)
    box = box_around(middle, wide, high)
    canvas.box(box, Paint.PAGE, Paint.PAGE, 0.0)
    for number, text in enumerate(texts):
        level = float(middle[1]) + 1.2 * size * (number - (len(texts) - 1) / 2)
        canvas.text((float(middle[0]), level), text, size, paint, align=0.5)
    return box


def draw_rounds(board: Board, sizes: CutSizes) -> None:
    """Draw the largest radii and diameters, each at one of its arcs, where there is room off the path."""
    for round_ in sizes.rounds[:MOST_ROUNDS]:
        if round_.radius_um * board.page.view.px_per_um >= _LEAST_ROUND * board.page.unit:
            _draw_round(board, round_, sizes.path)


def _draw_round(board: Board, round_: Round, path: Toolpath) -> None:
    canvas, page = board.canvas, board.page
    size, unit, paint = style.SIZE * page.unit, page.unit, Paint.ERROR if round_.off else Paint.SIZE
    text = round_.text(board.say)
    wide = text_width(text, size) + size / 2
    for arc, outward in _leaders(page, round_, path):
        reach = style.LEADER * unit + float(np.abs(outward) @ (wide, 1.2 * size)) / 2
        box = board.room.take_clear([box_around(arc + outward * reach, wide, 1.2 * size)])
        if box:
            canvas.arrow(arc, -outward, style.SIZE_ARROW * unit, Paint.SIZE)
            canvas.polyline(np.stack([arc, arc + outward * style.LEADER * unit]), paint, style.SIZE_WIDTH * unit)
            middle = ((box.left + box.right) / 2, (box.top + box.bottom) / 2)
            canvas.text(middle, text, size, paint, align=0.5)
            return


def _leaders(page: Page, round_: Round, path: Toolpath) -> Iterator[tuple[Floats, Floats]]:
    """Where a leader may touch the edge that an arc makes, and which way it goes from there: into what is kept first.

    The edge of a hole lies outside of its path, that of a boss inside.
    """
    longest = round_.rows[np.argsort(-np.abs(path.sweep_rad[round_.rows]), kind="stable")][:_MOST_ARCS]
    center = path.center_um[longest]
    side = 1.0 if round_.radius_um > float(path.radius_um[longest[0]]) else -1.0
    for way in (side, -side):
        for share in _ROUND_AT:
            points, _ = along(path, longest, np.full(len(longest), share))
            outward = (points - center) / path.radius_um[longest, None]
            edge = page.view.to_px(center + round_.radius_um * outward)
            yield from zip(edge, way * outward * (1.0, -1.0), strict=True)
