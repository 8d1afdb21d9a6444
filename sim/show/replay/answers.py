"""Questions about a block, its words and places as the quiz says them, and their answers, the wrong ones too."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from controller.stepping.strokes import walk_arcs
from parser.controller_words import Axis, StepWords
from parser.findings.catalogue import Bilingual
from parser.geometry.curves import Floats
from parser.step_words.words import label
from parser.units import mm
from sim.run.dryrun import DryRun
from sim.setup.quiz import About, WrittenQuestion
from sim.show.texts import bilingual
from sim.show.texts.phrases import same


class AskedBlock(NamedTuple):
    """One block, whole µm unless said otherwise.

    Attributes
    ----------
    name
        What people call the block.
    is_arc
        Whether it is an arc.
    start_um, end_um, center_um
        (2,) float64, exact places; the centre of a line is NaN.
    length_um
        Length of its curve.
    extent_um, count_um, axis, quadrant, turn
        Its words: X and Y, J, G as X or Y, the quadrant, and +1 for NR, −1 for SR, 0 for a line.
    first_step
        (2,) which way its first step goes; (0, 0) where it makes none.
    steps
        How many it makes.
    is_worded
        Whether its words stand in the program; else they are the controller's own.
    senses
        How the program writes arcs clockwise and counter-clockwise, such as ``SR`` and ``NR``.
    """

    name: str
    is_arc: bool
    start_um: Floats
    end_um: Floats
    center_um: Floats
    length_um: float
    extent_um: tuple[int, int]
    count_um: int
    axis: str
    quadrant: int
    turn: int
    first_step: tuple[int, int]
    steps: int
    is_worded: bool
    senses: tuple[str, str]

    @property
    def by_um(self) -> Floats:
        """From its start to its end, (2,) µm."""
        return self.end_um - self.start_um

    @property
    def kind(self) -> str:
        """``line`` or ``arc``."""
        return "arc" if self.is_arc else "line"

    @property
    def sense(self) -> str:
        """What tells the sense of an arc, as it is written: with the digit of its quadrant where it has one."""
        return label(self.turn, self.quadrant) if self.is_worded else self.senses[self.turn > 0]

    @property
    def motion(self) -> int:
        """Quadrant of its first step: on an axis that which an arc enters."""
        if not self.is_arc:
            return self.quadrant
        x, y = np.rint(self.start_um - self.center_um).astype(np.int64)
        unit = np.ones(1, dtype=np.int64)
        (quarter,) = walk_arcs(x * unit, y * unit, unit, unit, self.turn * unit).quarter.tolist()
        return int(quarter) + 1 if self.turn > 0 else 4 - int(quarter)


def asked_block(run: DryRun, words: StepWords, row: int, first_um: tuple[int, int] | None) -> AskedBlock:
    """The block in a row, whose first step leads to a place; `words` are those of all rows."""
    toolpath = run.toolpath
    from_x, from_y = run.stepped.corner_um[row].tolist()
    to_x, to_y = first_um or (from_x, from_y)
    return AskedBlock(
        name=toolpath.source.names.of_row(row),
        is_arc=bool(toolpath.is_arc[row]),
        start_um=toolpath.start_um[row],
        end_um=toolpath.end_um[row],
        center_um=toolpath.center_um[row],
        length_um=float(toolpath.length_um[row]),
        extent_um=(int(words.x_um[row]), int(words.y_um[row])),
        count_um=int(words.count_um[row]),
        axis=Axis(int(words.count_axis[row])).name,
        quadrant=int(words.quadrant[row]),
        turn=int(words.turn[row]),
        first_step=(to_x - from_x, to_y - from_y),
        steps=int(run.stepped.count[row]),
        is_worded=toolpath.words is not None,
        senses=run.program.reading.spelling[:2],
    )


def way(step: tuple[int, int]) -> str:
    """A step as people write it: +X, −X, +Y or −Y."""
    axis = "X" if step[0] else "Y"
    return f"{'+' if sum(step) > 0 else '−'}{axis}"


def signed(um: float) -> str:
    """A length in whole µm with its sign, none before 0."""
    whole = round(um)
    return str(whole) if not whole else f"{'+' if whole > 0 else '−'}{abs(whole)}"


def plain(um: int) -> str:
    """A coordinate in whole µm."""
    return str(um).replace("-", "−")


def in_mm(um: float) -> str:
    """A coordinate in mm with three digits, as programs print it, but never −0.000."""
    text = f"{mm(um):.3f}"
    return text.removeprefix("-") if float(text) == 0.0 else text.replace("-", "−")


_WRONG = 3
"""Wrong answers beside the right one, where there are as many."""
_APART_UM = 20.0
"""Wrong ends lie farther from the right one than steps ever end from it (docs/3b.md §3)."""
_EITHER_UM = 2
"""An arc that ends as near to one axis as to the other, to rounding, may count on either."""


def written_out(about: About, block: AskedBlock) -> WrittenQuestion | None:
    """A question about a block that makes a step; None where it has no wrong answers to offer.

    Only arcs are asked about their turn.
    """
    return _ABOUT[about](block)


def _quadrant(block: AskedBlock) -> WrittenQuestion | None:
    right = label(block.turn, block.motion)
    if not block.is_arc and block.motion != _ruled_digit(block):
        return None  # what is written is not what the rule says, and the rule is what is asked about
    from_x, from_y = (plain(um) for um in _from_center(block, block.start_um))
    why = bilingual(
        f"quiz.quadrant_{block.kind}_why", label=right, turn=_turn(block), from_x=from_x, from_y=from_y, **_moves(block)
    )
    return _among(
        [label(block.turn, digit) for digit in range(1, 5)], right, _ask(f"quiz.quadrant_{block.kind}", block), why
    )


def _ruled_digit(block: AskedBlock) -> int:
    """The digit of a line by the rule of docs/3b.md §1: along an axis that of its way, else its quadrant."""
    wide, high = block.extent_um
    if wide and high:
        return block.quadrant
    x, y = block.by_um.tolist()
    return (1 if x > 0 else 3) if wide else 2 if y > 0 else 4


def _count_axis(block: AskedBlock) -> WrittenQuestion:
    return _among(["GX", "GY"], f"G{block.axis}", _ask("quiz.count_axis", block), _why_axis(block))


def _why_axis(block: AskedBlock) -> Bilingual:
    """Why the block counts on its axis by the rule of docs/3b.md §1, or that it does not keep to it."""
    wide, high = block.extent_um
    to_x, to_y = _from_center(block, block.end_um)
    key, rule = _axis_of_arc(to_x, to_y, block.axis) if block.is_arc else _axis_of_line(block)
    key = key if rule == block.axis else "written"
    near = "Y" if rule == "X" else "X"
    values = {"wide": wide, "high": high, "to_x": plain(to_x), "to_y": plain(to_y), "near": near, "axis": block.axis}
    return bilingual(f"quiz.count_axis_{key}_why", **values)


def _axis_of_line(block: AskedBlock) -> tuple[str, str]:
    """Which rule tells the counted axis, and the axis."""
    wide, high = block.extent_um
    if wide == high:
        return "diagonal", "Y" if block.quadrant % 2 else "X"
    return "line", "X" if wide > high else "Y"


def _axis_of_arc(to_x: int, to_y: int, written: str) -> tuple[str, str]:
    if abs(abs(to_x) - abs(to_y)) <= _EITHER_UM:
        return "either", written
    return "arc", "Y" if abs(to_x) > abs(to_y) else "X"


def _turning(block: AskedBlock) -> WrittenQuestion:
    clockwise, counter_clockwise = block.senses
    words = {"clockwise": clockwise, "counter_clockwise": counter_clockwise}
    answers = [bilingual("quiz.turn_answer", turn=bilingual(f"quiz.{key}"), word=word) for key, word in words.items()]
    why = bilingual("quiz.turn_why", written=block.sense, **words)
    return WrittenQuestion(_ask("quiz.turn", block), tuple(answers), int(block.turn > 0), why)


def _count_length(block: AskedBlock) -> WrittenQuestion:
    axis = "XY".index(block.axis)
    others = (block.steps, abs(block.by_um[axis]), block.length_um, abs(block.by_um[1 - axis]), block.count_um * 2)
    wrong = [round(float(other)) for other in others if other >= 1]
    ask = bilingual("quiz.count_length", block=block.name, axis=block.axis)
    why = bilingual(f"quiz.count_length_{block.kind}_why", count=block.count_um, axis=block.axis)
    answers = sorted({block.count_um, *_some(wrong, block.count_um)})
    return _among([str(answer) for answer in answers], str(block.count_um), ask, why)


def _next_step(block: AskedBlock) -> WrittenQuestion:
    right = way(block.first_step)
    why = bilingual(f"quiz.next_step_{block.kind}_why", way=right, label=label(block.turn, block.motion))
    return _among(["+X", "−X", "+Y", "−Y"], right, _ask("quiz.next_step", block), why)


def _end(block: AskedBlock) -> WrittenQuestion | None:
    right = _place(block.end_um)
    answers = sorted({right, *_some([_place(place) for place in _other_ends(block)], right)})
    if len(answers) == 1:
        return None
    center_x, center_y = (in_mm(place) if block.is_arc else "" for place in block.center_um.tolist())
    start_x, start_y = (in_mm(place) for place in block.start_um.tolist())
    values = {"start_x": start_x, "start_y": start_y, "center_x": center_x, "center_y": center_y}
    kind = block.kind if block.is_worded else "line"  # the text on arcs tells how far one counts
    why = bilingual(
        f"quiz.end_{kind}_why",
        turn=_turn(block),
        count=block.count_um,
        axis=block.axis,
        **values,
        **_moves(block),
    )
    return WrittenQuestion(_ask("quiz.end", block), tuple(answers), answers.index(right), why)


def _other_ends(block: AskedBlock) -> list[Floats]:
    """Ends that a slip of reading gives: mirrored about the start, on an arc about its centre."""
    about = block.center_um if block.is_arc else block.start_um
    from_it = block.end_um - about
    flipped = [about + from_it * flip for flip in np.array([[-1, 1], [1, -1], [-1, -1]])]
    others = [*flipped, about + from_it[::-1], about - from_it[::-1], about + 2.0 * from_it]
    return [other for other in others if np.hypot(*(other - block.end_um)) >= _APART_UM]


def _place(place_um: Floats) -> Bilingual:
    x, y = (in_mm(place) for place in place_um.tolist())
    return bilingual("quiz.end_place", x=x, y=y)


def _some(wrong: Iterable[Any], right: object) -> list[Any]:
    """The first few wrong answers that differ from the right one and from each other."""
    return [answer for answer in dict.fromkeys(wrong) if answer != right][:_WRONG]


def _among(answers: list[str], right: str, ask: Bilingual, why: Bilingual) -> WrittenQuestion:
    """A question whose answers need no words, in their order."""
    return WrittenQuestion(ask, tuple(same(answer) for answer in answers), answers.index(right), why)


def _ask(key: str, block: AskedBlock) -> Bilingual:
    return bilingual(key, block=block.name)


def _turn(block: AskedBlock) -> Bilingual:
    return bilingual("quiz.counter_clockwise" if block.turn > 0 else "quiz.clockwise")


def _moves(block: AskedBlock) -> dict[str, str]:
    by_x, by_y = block.by_um.tolist()
    return {"by_x": signed(by_x), "by_y": signed(by_y)}


def _from_center(block: AskedBlock, place_um: Floats) -> tuple[int, int]:
    """Place from the centre in whole µm; (0, 0) on a line."""
    if not block.is_arc:
        return 0, 0
    x, y = np.rint(place_um - block.center_um).astype(int).tolist()
    return x, y


_ABOUT: Mapping[About, Callable[[AskedBlock], WrittenQuestion | None]] = {
    "quadrant": _quadrant,
    "count_axis": _count_axis,
    "turn": _turning,
    "count_length": _count_length,
    "next_step": _next_step,
    "end": _end,
}
