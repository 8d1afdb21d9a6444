"""A draft as ISO, in the way of any dialect that has a profile, and what may be chosen of that way.

The words of compensation in an ISO text: sides, registers and their values, by the rows of a draft.

How ISO is to be written: a profile, the habits of its family, and what is chosen otherwise.
"""

import tomllib
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import cache
from itertools import count
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np

from parser.controller_words import Compensation, Taper
from parser.findings.errors import SettingsError
from parser.geometry.curves import CurveKind, Ints
from parser.iso.profiles.profile import Profile, profile
from parser.units import UM_PER_MM, mm
from parser.write.draft import Draft, Written, optional_stops, written_events
from parser.write.strokes import Strokes, strokes_of
from parser.write.two_contours import PairedStrokes, aside, in_one_block, paired_strokes

Unit = Literal["um", "mm", "inch"]
UM_PER_INCH = 25_400.0
_UM: dict[Unit, float] = {"um": 1.0, "mm": UM_PER_MM, "inch": UM_PER_INCH}
_DECIMALS: dict[Unit, int] = {"um": 0, "mm": 3, "inch": 5}


@dataclass(frozen=True, slots=True)
class Habits:
    """How programs of a family are written; ``habits.toml`` says what each key is."""

    unit: Unit
    number_step: int
    tape: bool
    head: tuple[str, ...]
    end: str
    offset: str
    digits: int
    sets_offsets: bool
    offset_on: str
    side_alone: bool
    says_unit: bool
    starts_by: Literal["place", "rapid"]
    before_cut: tuple[str, ...]
    behind_cut: tuple[str, ...]
    arc_feed: str
    trims_zeros: bool
    two_contours: Literal["colon", "uv", "none"]
    two_sides: tuple[str, str, str]


class IsoChoices(NamedTuple):
    """How ISO is to be written.

    Attributes
    ----------
    profile, habits
        Of the dialect.
    unit, decimals
        Of its numbers; without a point where there are no decimals.
    distance, centers
        As in `Profile`.
    number_step
        Between the N of blocks; 0 without N.
    tape
        Whether a ``%`` begins and ends it.
    """

    profile: Profile
    habits: Habits
    unit: Unit
    decimals: int
    distance: Literal["absolute", "incremental"]
    centers: Literal["from-start", "absolute"]
    number_step: int
    tape: bool

    @property
    def step_um(self) -> float:
        """Least step that its numbers are written in."""
        return round(_UM[self.unit] / 10.0**self.decimals, 9)

    @property
    def reading_unit(self) -> Unit | Literal[""]:
        """The unit that its text is to be read with: none where the text says it, or it is that of the dialect."""
        says = self.unit == "inch" or self.habits.says_unit
        return "" if says else self.unit

    def number(self, steps: int) -> str:
        """A number of steps as text."""
        if not self.decimals:
            return f"{steps}"
        whole, digits = f"{steps / 10**self.decimals:.{self.decimals}f}".split(".")
        return f"{whole}.{(digits.rstrip('0') or '0') if self.habits.trims_zeros else digits}"


def iso_choices(dialect: str, unit: Unit | None = None, decimals: int | None = None) -> IsoChoices:
    """The usual choices of a dialect by its name; with another unit, and other decimals, where they are given.

    SettingsError where the dialect has no such numbers.
    """
    of, habits = profile(dialect), _habits(dialect)
    unit = unit or habits.unit
    if unit == "um" and of.integer_um != _UM["um"]:
        raise SettingsError("unit-um-not-for-dialect", dialect=of.name)
    fine = _DECIMALS[unit] if decimals is None or unit == "um" else decimals
    return IsoChoices(of, habits, unit, fine, of.distance, of.centers, habits.number_step, habits.tape)


@cache
def _habits(name: str) -> Habits:
    """Of a profile: its own over those of ``common``."""
    values: dict[str, Any] = tomllib.loads(Path(__file__).with_name("habits.toml").read_text(encoding="utf-8"))
    own = {**values["common"], **values[name]}
    columns: dict[str, Any] = {key: tuple(value) if isinstance(value, list) else value for key, value in own.items()}
    return Habits(**columns)


_SIDES = {1: "G41", -1: "G42", 0: "G40"}


class Sides(NamedTuple):
    """What stands before the blocks of a row, and in the first of them; by rows of the draft.

    Attributes
    ----------
    before
        Blocks of their own: values of registers, sides that stand alone.
    first, last
        Words that begin the block, and that end it.
    outside
        Registers whose values stand in the controller's table, by their names as written; µm.
    """

    before: dict[int, list[str]]
    first: dict[int, str]
    last: dict[int, str]
    outside: dict[str, float]


def sides_of(compensation: Compensation | None, choices: IsoChoices, *, of_two: bool = False) -> Sides:
    """The words of a draft's compensation; those `of_two` contours stand alone, since both then have them."""
    sides = Sides({}, {}, {}, {})
    if compensation is None:
        return sides
    names = _names(compensation, choices)
    in_force: dict[str, float] = {}
    changes = _changes(compensation, names)
    if changes and choices.habits.offset_on:
        sides.before[changes[0]] = [choices.habits.offset_on]
    for row in changes:
        side, name, by_um = int(compensation.side[row]), names[row], float(compensation.by_um[row])
        if side and not np.isnan(by_um) and in_force.get(name) != by_um:
            _tell_value(sides, row, name, by_um, choices)
            in_force[name] = by_um
        word = choices.habits.two_sides[side] if of_two else _SIDES[side]
        words = [word, name] if side and name else [word]
        if choices.habits.side_alone or of_two:
            sides.before.setdefault(row, []).append(" ".join(words))
        else:
            sides.first[row], sides.last[row] = words[0], " ".join(words[1:])
    return sides


def registers_of(compensation: Compensation | None, choices: IsoChoices) -> tuple[tuple[str, float], ...]:
    """Names without leading zeros, and values in µm, of the registers that a text leaves to the controller's table."""
    outside = sides_of(compensation, choices).outside
    return tuple((f"{name[0]}{int(name[1:])}", by_um) for name, by_um in outside.items())


def _tell_value(sides: Sides, row: int, name: str, by_um: float, choices: IsoChoices) -> None:
    if choices.habits.sets_offsets:
        sides.before.setdefault(row, []).append(f"{name}={_value(by_um, choices)}")
    else:
        sides.outside[name] = by_um


def _value(by_um: float, choices: IsoChoices) -> str:
    if choices.unit == "inch":
        return f"{by_um / UM_PER_INCH:.6f}"
    if choices.unit == "um" and by_um == round(by_um):
        return f"{round(by_um / choices.profile.register_integer_um)}"
    return f"{by_um / choices.profile.register_point_um:.4f}"


def _names(compensation: Compensation, choices: IsoChoices) -> list[str]:
    """The register of each row as the dialect writes it; empty where there is none.

    Where the program cannot set a register, each further value of one gets a register of its own. Where register 0 is
    always 0, numbers begin with 1.
    """
    numbers: dict[tuple[str, float], int] = {}
    names = []
    for name, side, by_um in zip(
        compensation.register, compensation.side.tolist(), compensation.by_um.tolist(), strict=True
    ):
        key = (name, 0.0 if choices.habits.sets_offsets or np.isnan(by_um) else by_um)
        if side and name and key not in numbers:
            numbers[key] = _free(int(name[1:]), numbers.values(), choices)
        names.append(f"{choices.habits.offset}{numbers[key]:0{choices.habits.digits}d}" if side and name else "")
    return names


def _free(wished: int, taken: Collection[int], choices: IsoChoices) -> int:
    """The number that is wished for, or the next one that is free."""
    least = max(wished, 1 if choices.profile.zero_register_is_off else 0)
    return next(number for number in count(least) if number not in taken)


def _changes(compensation: Compensation, names: list[str]) -> list[int]:
    """Rows with another side, register or value than the row before; without a side at first."""
    changes, last = [], (0, "", 0.0)
    for row, (side, by_um) in enumerate(zip(compensation.side.tolist(), compensation.by_um.tolist(), strict=True)):
        now = (side, names[row], by_um if side else 0.0)
        if now != last and not (now[:2] == last[:2] and np.isnan(by_um)):
            changes.append(row)
        last = now
    return changes


_LEANS = {1: "G51", -1: "G52", 0: "G50"}
_ANGLE_DECIMALS = 6


def leans_of(taper: Taper | None, choices: IsoChoices) -> dict[int, str]:
    """The words of a draft's lean, by the rows at which another one begins: side and angle, or G50."""
    found: dict[int, str] = {}
    if taper is None:
        return found
    last = (0, 0.0)
    for row, (side, angle_rad) in enumerate(zip(taper.side.tolist(), taper.angle_rad.tolist(), strict=True)):
        now = (side, angle_rad if side else 0.0)
        if now != last:
            angle = np.degrees(angle_rad) / choices.profile.angle_point_deg
            number = f"{angle:.{_ANGLE_DECIMALS}f}".rstrip("0")
            found[row] = f"{_LEANS[side]} {choices.profile.angle}{number}" if side else _LEANS[side]
        last = now
    return found


_PAUSE, _OPTIONAL_PAUSE = "M00", "M01"
_TAPE = "%"
_UNITS = {"um": "0.001 mm", "mm": "mm", "inch": "inches"}


def written_iso(draft: Draft, choices: IsoChoices) -> Written:
    """Text of a draft in ISO (docs/iso.md §10).

    SettingsError where the dialect cannot say what the draft needs.
    """
    if draft.upper is None:
        strokes = strokes_of(draft, choices.step_um)
        made = _Blocks(_blocks(draft, choices, strokes), strokes.row)
    else:
        made = _of_two_contours(draft, choices)
    sides = sides_of(draft.compensation, choices, of_two=draft.upper is not None)
    numbered = _numbered([*_head(draft, choices), *_body(draft, choices, made, sides)], choices.number_step)
    tape = [_TAPE] if choices.tape else []
    lines = [*tape, *_remarks(choices, sides), *numbered, *tape, ""]
    return Written("\n".join(lines), made.row)


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


class _Blocks(NamedTuple):
    """Blocks that move the wire, and the row (m,) of the draft that each is of."""

    text: list[str]
    row: Ints


def _body(draft: Draft, choices: IsoChoices, made: _Blocks, sides: Sides) -> Iterator[str]:
    """Blocks in order, with what stands between them, by the rows that they are of."""
    pauses = {stop.after for stop in draft.stops if stop.kind == "pause"}
    pauses |= set(np.flatnonzero(draft.is_placed).tolist())
    first = np.searchsorted(made.row, np.arange(len(draft) + 1)).tolist()
    begins, ends = _about_cuts(draft)
    events, optional = written_events(draft.events), optional_stops(draft.events)
    leans = leans_of(draft.taper, choices)
    for row in range(len(draft)):
        if row in ends:
            yield from choices.habits.behind_cut
        if row in pauses:
            yield _OPTIONAL_PAUSE if row in optional else _PAUSE
        if row in begins:
            yield from choices.habits.before_cut
        yield from events.get(row, [])
        yield from sides.before.get(row, [])
        begun = " ".join(filter(None, (leans.get(row, ""), sides.first.get(row, ""))))
        closed = sides.last.get(row, "")
        for block in made.text[first[row] : first[row + 1]]:
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


def _of_two_contours(draft: Draft, choices: IsoChoices) -> _Blocks:
    """Blocks of two contours. SettingsError where the dialect has no words of such."""
    if choices.habits.two_contours == "none":
        raise SettingsError("dialect-without-two-contours", dialect=choices.profile.name)
    if choices.habits.two_contours == "uv" and draft.compensation is not None and draft.compensation.side.any():
        raise SettingsError("uv-without-compensation", dialect=choices.profile.name)
    pair = paired_strokes(draft, choices.step_um)
    return _Blocks(_paired_blocks(draft, choices, pair), pair.lower.row)


def _paired_blocks(draft: Draft, choices: IsoChoices, pair: PairedStrokes) -> list[str]:
    """Blocks of two contours, in the words of the dialect."""
    below = _blocks(draft, choices, pair.lower)
    if choices.habits.two_contours == "colon":
        return in_one_block(below, _blocks(draft, choices, pair.upper), choices.profile.planes)
    to = aside(pair, is_absolute=choices.distance == "absolute")
    return [
        block if words is None else " ".join([block, *_words("UV", words, choices)])
        for block, words in zip(below, to, strict=True)
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
