"""A draft as ISO, in the way of any dialect that has a profile."""

from collections.abc import Iterator

import numpy as np

from parser.geometry.curves import CurveKind, Ints
from parser.units import mm
from parser.write.draft import Draft, Written
from parser.write.events import optional_stops, written_events
from parser.write.iso_choices import IsoChoices
from parser.write.sides import Sides, sides_of
from parser.write.strokes import Strokes, strokes_of

_PAUSE, _OPTIONAL_PAUSE = "M00", "M01"
_TAPE = "%"
_UNITS = {"um": "0.001 mm", "mm": "mm", "inch": "inches"}


def written_iso(draft: Draft, choices: IsoChoices) -> Written:
    """Text of a draft in ISO (docs/iso.md §10).

    SettingsError where the dialect cannot say what the draft needs.
    """
    strokes = strokes_of(draft, choices.step_um)
    sides = sides_of(draft.compensation, choices)
    numbered = _numbered([*_head(draft, choices), *_body(draft, choices, strokes, sides)], choices.number_step)
    tape = [_TAPE] if choices.tape else []
    lines = [*tape, *_remarks(choices, sides), *numbered, *tape, ""]
    return Written("\n".join(lines), strokes.row)


def _remarks(choices: IsoChoices, sides: Sides) -> Iterator[str]:
    """What was chosen, without a word that could be one of the program; and values that it cannot hold."""
    unit = _UNITS[choices.unit]
    yield f"({choices.profile.name}, {unit}, {choices.distance}, centres {choices.centers.replace('-', ' ')})"
    for name, by_um in sides.outside.items():
        yield f"(offset of register {int(name[1:])}: {mm(by_um):.4f} mm)"


def _head(draft: Draft, choices: IsoChoices) -> Iterator[str]:
    habits, profile = choices.habits, choices.profile
    yield from (word for word in habits.head if word.startswith("O"))
    modes = [word for word in habits.head if not word.startswith("O")]
    if habits.says_unit or choices.unit == "inch":
        modes.append("G20" if choices.unit == "inch" else "G21")
    if choices.centers != profile.centers:
        modes.append("G90.1" if choices.centers == "absolute" else "G91.1")
    starts_by_place = habits.starts_by == "place"
    if starts_by_place or choices.distance != profile.distance:
        modes.append("G90" if choices.distance == "absolute" else "G91")
    if not starts_by_place:
        yield from filter(None, [" ".join(modes)])
        return
    start = (
        np.rint(draft.curves.start_um[0] / choices.step_um).astype(np.int64) if len(draft) else np.zeros(2, np.int64)
    )
    yield " ".join([*modes, "G92", *_words("XY", start, choices)])


def _body(draft: Draft, choices: IsoChoices, strokes: Strokes, sides: Sides) -> Iterator[str]:
    """Blocks in order, with what stands between them, by the rows that they are of."""
    pauses = {stop.after for stop in draft.stops if stop.kind == "pause"}
    pauses |= set(np.flatnonzero(draft.is_placed).tolist())
    first = np.searchsorted(strokes.row, np.arange(len(draft) + 1)).tolist()
    blocks = _blocks(draft, choices, strokes)
    begins, ends = _about_cuts(draft)
    events, optional = written_events(draft.events), optional_stops(draft.events)
    for row in range(len(draft)):
        if row in ends:
            yield from choices.habits.behind_cut
        if row in pauses:
            yield _OPTIONAL_PAUSE if row in optional else _PAUSE
        if row in begins:
            yield from choices.habits.before_cut
        yield from events.get(row, [])
        yield from sides.before.get(row, [])
        begun, closed = sides.first.get(row, ""), sides.last.get(row, "")
        for block in blocks[first[row] : first[row + 1]]:
            yield " ".join(filter(None, (begun, block, closed)))
            begun = closed = ""
    if len(draft) in ends:
        yield from choices.habits.behind_cut
    yield from events.get(len(draft), [])
    yield choices.habits.end


def _about_cuts(draft: Draft) -> tuple[set[int], set[int]]:
    """Rows with which cuts begin, and rows behind those with which they end: at jumps, and where the path does."""
    is_cut = np.concatenate([[False], draft.curves.kind != CurveKind.JUMP, [False]])
    begins, ends = (np.flatnonzero(is_cut[1:] & ~is_cut[:-1]), np.flatnonzero(is_cut[:-1] & ~is_cut[1:]))
    return set(begins.tolist()), set(ends.tolist())


def _blocks(draft: Draft, choices: IsoChoices, strokes: Strokes) -> list[str]:
    by = strokes.end - strokes.start
    to = strokes.end if choices.distance == "absolute" else by
    center = strokes.to_center + (strokes.start if choices.centers == "absolute" else 0)
    placed = draft.is_placed[strokes.row].tolist()
    return [
        _placed(strokes.end[at], choices) if placed[at] else _block(motion, to[at], center[at], choices)
        for at, motion in enumerate(strokes.motion.tolist())
    ]


def _placed(place: Ints, choices: IsoChoices) -> str:
    return " ".join(["G92", *_words("XY", place, choices)])


def _block(motion: int, to: Ints, center: Ints, choices: IsoChoices) -> str:
    words = [f"G0{motion}", *_words("XY", to, choices)]
    feed = [choices.habits.arc_feed] if choices.habits.arc_feed else []
    return " ".join([*words, *_words("IJ", center, choices), *feed] if motion >= 2 else words)


def _words(letters: str, steps: Ints, choices: IsoChoices) -> list[str]:
    return [letter + choices.number(value) for letter, value in zip(letters, steps.tolist(), strict=True)]


def _numbered(blocks: list[str], step: int) -> list[str]:
    """Blocks with their N, but for the number of the program and values of registers, which have none."""
    if not step:
        return blocks
    numbered, number = [], 0
    for block in blocks:
        number += step
        numbered.append(f"N{number} {block}")
    return numbered
