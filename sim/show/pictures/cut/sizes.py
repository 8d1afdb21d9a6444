"""Which sizes a picture gives: width and height of what is kept, and its largest radii, as they are meant to be."""

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.shape.contours import contour_rows
from parser.shape.loops import Loops, find_loops
from parser.toolpath import Toolpath
from parser.units import mm_text
from sim.show.draw.flatten import bounds_um, flatten
from sim.show.pictures.cut.subject import Cut

if TYPE_CHECKING:  # of a path none are known, and their rooms take long to load
    from sim.cut.pieces.pieces import Pieces
    from sim.cut.sizes.sizes import Sizes

LEAST_SWEEP_RAD: Final = np.radians(30.0)
_WHOLE_RAD: Final = np.radians(359.0)
_SAME_UM: Final = 10.0  # centres this near are one
_ORIENTATION_UM: Final = 10.0  # chords that tell which way a loop turns


class Round(NamedTuple):
    """Arcs of one nominal radius µm: their rows, how many circles or corners they are, and whether whole circles."""

    radius_um: float
    rows: Ints
    number: int
    whole: bool

    @property
    def text(self) -> str:
        """A size such as ``2× Ø 10`` or ``R 2.5``."""
        size = f"Ø {length_text(2.0 * self.radius_um)}" if self.whole else f"R {length_text(self.radius_um)}"
        return size if self.number == 1 else f"{self.number}× {size}"


class CutSizes(NamedTuple):
    """Sizes to be shown: a box (2, 2) µm, None where there is none, and radii on arcs of `path`, the largest first.

    There is no box where nothing closes, or where all of it goes into the kerf. With `of_path` the box is that of the
    path: nothing tells on which side of it the part lies.
    """

    box_um: Floats | None
    rounds: tuple[Round, ...]
    path: Toolpath
    of_path: bool


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
        return _measured(cut.toolpath, cut.sizes)
    if cut.contour is not None:
        return _of_path(cut.contour, 0.0, cut.pieces)
    return _of_path(cut.toolpath, cut.kerf_um / 2, cut.pieces)


def _measured(toolpath: Toolpath, sizes: "Sizes") -> CutSizes:
    box = max(sizes.boxes, key=lambda each_box: each_box.nominal_um.x * each_box.nominal_um.y)
    half, centre = np.array(box.nominal_um) / 2, np.array(box.center_um)
    row = np.array([each.block - 1 for each in sizes.radii], dtype=np.int64)
    arcs = _Arcs(row, np.array([each.nominal_um for each in sizes.radii], dtype=np.float64))
    return CutSizes(np.stack([centre - half, centre + half]), _rounds(toolpath, arcs), toolpath, of_path=False)


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
