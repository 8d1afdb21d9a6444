"""The words of compensation in an ISO text: sides, registers and their values, by the rows of a draft."""

from collections.abc import Collection
from itertools import count
from typing import NamedTuple

import numpy as np

from parser.told.compensation import Compensation
from parser.write.iso_choices import UM_PER_INCH, IsoChoices

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


def sides_of(compensation: Compensation | None, choices: IsoChoices) -> Sides:
    """The words of a draft's compensation."""
    sides = Sides({}, {}, {}, {})
    if compensation is None:
        return sides
    names = _names(compensation, choices)
    held: dict[str, float] = {}
    changes = _changes(compensation, names)
    if changes and choices.habits.offset_on:
        sides.before[changes[0]] = [choices.habits.offset_on]
    for row in changes:
        side, name, by_um = int(compensation.side[row]), names[row], float(compensation.by_um[row])
        if side and not np.isnan(by_um) and held.get(name) != by_um:
            _tell_value(sides, row, name, by_um, choices)
            held[name] = by_um
        words = [_SIDES[side], name] if side and name else [_SIDES[side]]
        if choices.habits.side_alone:
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
