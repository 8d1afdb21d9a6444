"""A draft as 3B or 4B, in the three forms of CAXA: compact, aligned, and with a header and the end of each block."""

import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import count
from typing import Literal, NamedTuple

import numpy as np

from parser.controller_words import Axis, StepWords
from parser.geometry.curves import Bools, CurveKind, Floats, Ints
from parser.step_words.chained import Chained, chained_words
from parser.step_words.nearest import nearest_words
from parser.step_words.words import label
from parser.units import mm
from parser.write.draft import Draft, Written

Form = Literal["compact", "aligned", "detailed"]
_RULE = "*" * 40
_CURVES = ("", "D", "DD")
_PAUSE, _END = "D", "DD"
_CODE = re.compile(rf"(?m)^((?:N *\d+: )?)({_END}|{_PAUSE})(?=\r?$)")


class ThreeBChoices(NamedTuple):
    """How 3B is to be written.

    Attributes
    ----------
    form
        ``compact`` is glued, ``aligned`` in columns; ``detailed`` has labels, the ends of blocks and a header too.
    name
        Of the program, for the header.
    offset_um
        Offset that the path has, for the header; None where it is not known.
    curve
        4B: (n,) 1 for convex arcs, 2 for concave ones, 0 on lines. None for 3B.
    """

    form: Form = "compact"
    name: str = ""
    offset_um: float | None = None
    curve: Ints | None = None


def written_3b(draft: Draft, choices: ThreeBChoices) -> Written:
    """Text of a draft in 3B, or in 4B where the choices have a curve mark for each row (docs/3b.md §1, §2, §6).

    A jump stands behind a pause: one that is placed as a start node, any other as a line in the air. Blocks that whole
    µm leave no length are left out; of two contours, which are two texts with the same blocks, where both do not move.
    """
    words = _words_of(draft)
    moves = words.words.count_um > 0
    if draft.upper is None:
        return _written(draft, choices, words, moves)
    above = replace(draft, curves=draft.upper, told_um=np.full_like(draft.told_um, np.nan), words=None, upper=None)
    others = _words_of(above)
    moves |= others.words.count_um > 0
    return _written(draft, choices, words, moves)._replace(upper=_written(above, choices, others, moves).text)


def _written(draft: Draft, choices: ThreeBChoices, said: Chained, moves: Bools) -> Written:
    """Text of a draft with blocks of the rows (n,) that move."""
    is_block = moves & ~draft.is_placed
    lines = [*_head(draft, choices), *_body(draft, choices, said, is_block)]
    return Written("\n".join([*lines, ""]), np.flatnonzero(is_block | draft.is_placed))


def with_codes(text: str, end: str | None, pause: str | None) -> str:
    """A written text with other words for its end and its pauses; None leaves them."""
    codes = {_END: end or _END, _PAUSE: pause or _PAUSE}
    return _CODE.sub(lambda found: found[1] + codes[found[2]], text)


def with_usual_codes(data: bytes, end: bytes | None, pause: bytes | None) -> bytes:
    """Bytes of a text that `with_codes` changed, with the words for its end and its pauses that every reader knows."""
    usual = {end or _END.encode(): _END.encode(), pause or _PAUSE.encode(): _PAUSE.encode()}
    codes = b"|".join(re.escape(code) for code in usual)
    alone = rb"(?m)^([ \t]*(?:N[ \t]*\d+[ \t]*:[ \t]*)?)(" + codes + rb")(?=[ \t]*\r?$)"
    return re.sub(alone, lambda found: found[1] + usual[found[2]], data)


def _words_of(draft: Draft) -> Chained:
    """Words of the rows, and where they end: as they are, or told one from the end of the other."""
    if draft.words is not None:
        return Chained(draft.words, draft.curves.end_um)
    if draft.is_meant:
        return nearest_words(draft.curves, draft.is_placed)
    return chained_words(draft.curves, draft.told_um, draft.is_placed)


def _head(draft: Draft, choices: ThreeBChoices) -> Iterator[str]:
    """Remark, header and start; a start at (0, 0) goes without saying but in the detailed form."""
    yield f"// {'3B' if choices.curve is None else '4B'}, 0.001 mm, {choices.form}"
    start = draft.curves.start_um[0] if len(draft) else np.zeros(2)
    if choices.form == "detailed":
        offset = "" if choices.offset_um is None else f"Conner R= 0.00000 , Offset F= {mm(choices.offset_um):.5f} ,"
        cut_um = float(draft.curves.length_um[draft.curves.kind != CurveKind.JUMP].sum())
        yield from (_RULE, f"Name : {choices.name}", f"{offset}Length= {mm(cut_um):.3f} mm", _RULE)
    if choices.form == "detailed" or start.any():
        yield _node(start)


def _body(draft: Draft, choices: ThreeBChoices, chained: Chained, is_block: Bools) -> Iterator[str]:
    """Blocks with the marks between them, in the detailed form with labels and ends."""
    numbers = _numbers(chained.words, choices.curve)
    width = len(str(max(map(max, numbers), default=0)))
    pauses = _pauses(draft)
    labels = (f"N{number:>4}: " if choices.form == "detailed" else "" for number in count(1))
    for row in range(len(draft)):
        if row in pauses:
            yield next(labels) + _PAUSE
        if draft.is_placed[row]:
            yield _node(chained.end_um[row])
        elif is_block[row]:
            words = [*_spelt(numbers[row], choices.form, width), *_axis_and_label(chained.words, row, choices.curve)]
            code = ("" if choices.form == "compact" else " ").join(words)
            yield next(labels) + code + (_printed(chained.end_um[row]) if choices.form == "detailed" else "")
    yield next(labels) + _END


def _pauses(draft: Draft) -> set[int]:
    """Rows before which the program pauses: also before a jump, for which the wire is taken out.

    A way in the air that comes from another language ends with a pause as well, in which the wire is threaded again.
    """
    is_jump = draft.curves.kind == CurveKind.JUMP
    after = {stop.after for stop in draft.stops if stop.kind == "pause"}
    after |= set((np.flatnonzero(is_jump[1:] & ~is_jump[:-1]) + 1).tolist())
    if draft.words is None:
        after |= set((np.flatnonzero(is_jump[:-1] & ~is_jump[1:] & ~draft.is_placed[:-1]) + 1).tolist())
    return after


def _numbers(words: StepWords, curve: Ints | None) -> list[list[int]]:
    """X, Y and J of each row, and R in 4B."""
    columns = [words.x_um, words.y_um, words.count_um]
    if curve is not None:
        columns.append(np.where(words.turn != 0, np.rint(np.hypot(words.x_um, words.y_um)).astype(np.int64), 0))
    numbers: list[list[int]] = np.column_stack(columns).tolist()
    return numbers


def _spelt(numbers: list[int], form: Form, width: int) -> list[str]:
    return [f"B{number}" if form == "compact" else f"B {number:>{width}}" for number in numbers]


def _axis_and_label(words: StepWords, row: int, curve: Ints | None) -> tuple[str, str]:
    mark = "" if curve is None else _CURVES[int(curve[row])]
    axis = f"G{Axis(int(words.count_axis[row])).name}{mark}"
    return axis, label(int(words.turn[row]), int(words.quadrant[row]))


def _printed(end_um: Floats) -> str:
    x, y = _mm(end_um)
    return f" ; {x:10.3f} , {y:10.3f}"


def _node(place_um: Floats) -> str:
    x, y = _mm(place_um)
    return f"Start Point = {x:.5f} , {y:.5f} ; X , Y"


def _mm(place_um: Floats) -> list[float]:
    """A place in mm, without the sign of a 0 that is rounding."""
    place: list[float] = (np.round(mm(place_um), 5) + 0.0).tolist()
    return place
