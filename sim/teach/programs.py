"""Programs in any language that drycut reads, marked as lessons mark them."""

import numpy as np

from controller.offset.programmed import compensated
from parser.controller_words import StepWords
from parser.dialect.reader import Choices
from parser.findings.codes import CODES, Check, Severity
from parser.geometry.curves import Curves
from parser.program import Program, parse_program
from sim.teach.plain.blocks import Block, read_listing
from sim.teach.plain.curves import Curve, Point, decoded
from sim.teach.plain.program import ProgramMark, Target, Variant, Written, first_wrong, program_mark

_REGISTERS = 100


def program_marked(text: str, name: str, target: Target, offset_um: float) -> ProgramMark:
    """Mark of a program in 3B, 4B or ISO.

    Where the control has the offset, as in ISO with G41 and in 4B, it is set there as the exercise has it. Programs in
    3B and 4B say no place: they are threaded where the exercise is. ProgramError where nothing can be read.
    """
    registers = tuple((f"{letter}{number}", offset_um) for letter in "DH" for number in range(_REGISTERS))
    program = parse_program(text, name, choices=Choices(registers=registers))
    path = program.toolpath
    if path.words is None:
        way = compensated(path).path.curves if path.compensation is not None else path
        return program_mark(target, Written(plain_curves(way), _is_read(program), -1, 0, _ends(program)))
    start = path.start_um[0]
    moved = [_moved(curve, target.thread.x - start[0], target.thread.y - start[1]) for curve in plain_curves(path)]
    blocks = blocks_of(path.words)
    wrong = first_wrong(blocks, decoded(blocks, target.thread))
    written = Written(moved, _is_read(program), 1 if wrong == 0 else 0, wrong, _ends(program))
    return program_mark(_of_drawing(target) if (path.words.radius_um >= 0).any() else target, written)


def _of_drawing(target: Target) -> Target:
    """A target for 4B, whose programs go along the drawing itself."""
    drawn = [variant for variant in target.variants if variant.name == "no-offset"] or target.variants[:1]
    return target._replace(variants=[Variant("right", variant.curves) for variant in drawn])


def _is_read(program: Program) -> bool:
    return bool(len(program.toolpath)) and not any(
        found.severity is Severity.ERROR and CODES[found.code].check is Check.GRAMMAR for found in program.findings
    )


def _ends(program: Program) -> bool:
    """Whether there is an end code, and in 3B nothing behind it."""
    is_last = program.toolpath.words is None or read_listing(program.text).behind_end == 0
    return is_last and any(stop.kind == "end" for stop in program.toolpath.stops)


def blocks_of(words: StepWords) -> list[Block]:
    """Blocks of a path in the words of 3B; their lines are their numbers."""
    columns = (words.x_um, words.y_um, words.count_um, words.count_axis, words.turn, words.quadrant)
    rows = np.stack([*columns, np.arange(1, len(words.x_um) + 1)], axis=1).tolist()
    return [Block(*row) for row in rows]


def plain_curves(curves: Curves) -> list[Curve]:
    """Curves as a lesson has them."""
    turn = np.sign(curves.sweep_rad).astype(int).tolist()
    centre = np.where(curves.is_arc[:, None], curves.center_um, curves.start_um).tolist()
    number = (np.nan_to_num(column).tolist() for column in (curves.radius_um, curves.start_angle_rad, curves.sweep_rad))
    places = (curves.start_um.tolist(), curves.end_um.tolist())
    return [
        Curve(each_turn, Point(*start), Point(*end), Point(*middle), *figures)
        for each_turn, start, end, middle, *figures in zip(turn, *places, centre, *number, strict=True)
    ]


def _moved(curve: Curve, x: float, y: float) -> Curve:
    start, end, centre = (Point(place.x + x, place.y + y) for place in (curve.start, curve.end, curve.centre))
    return curve._replace(start=start, end=end, centre=centre)
