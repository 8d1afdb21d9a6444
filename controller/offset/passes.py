"""The contours of a toolpath in the order in which passes run them: each round once for each pass, as drawn or back."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from controller.offset.shifted import OffsetSection, Round
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.toolpath import Stop, Toolpath


class PassedRound(NamedTuple):
    """One pass over one round: its place among the rows in running order, and the pass, from 0."""

    round: Round
    number: int


@dataclass(frozen=True, slots=True, eq=False)
class PassedPath:
    """A toolpath in passes: all of one round before the next begins. n rows, in the order in which they run.

    Attributes
    ----------
    drawn
        The toolpath, each round once.
    curves
        Rows of a pass that runs back are turned round. A pass may begin some µm from where the one before it ended, and
        a jump elsewhere, behind a pass that ended at the other end of its contour.
    row
        (n,) the row of `drawn` that each is.
    number
        (n,) the pass that each belongs to, from 0; −1 outside of rounds.
    is_back
        (n,) whether it runs against its own direction.
    rounds
        The rounds in running order.
    stops
        Pauses and the end: those within a round in each pass, others once, behind the last pass over what they follow.
    """

    drawn: Toolpath
    curves: Curves
    row: Ints
    number: Ints
    is_back: Bools
    rounds: tuple[PassedRound, ...]
    stops: tuple[Stop, ...]

    @property
    def sections(self) -> tuple[OffsetSection, ...]:
        """Blocks that are offset, of each round."""
        return tuple(round_.round.section for round_ in self.rounds)


class NoWayBack(NamedTuple):
    """A pass that cannot begin: the round of the toolpath as drawn, and how far off the pass before it ended."""

    round: Round
    number: int
    gap_um: float


class _Stretch(NamedTuple):
    """Rows of the toolpath, from `begin` up to but without `past`, run in a pass, or outside of all."""

    begin: int
    past: int
    number: int = -1
    is_back: bool = False

    @property
    def row(self) -> Ints:
        """Its rows in running order."""
        rows = np.arange(self.begin, self.past)
        return rows[::-1] if self.is_back else rows


def in_passes(toolpath: Toolpath, rounds: Sequence[Round], back: Sequence[bool]) -> PassedPath:
    """A toolpath with each of its rounds run once for each pass; `back` (k,) says which passes run backwards."""
    stretches: list[_Stretch] = []
    passed: list[PassedRound] = []
    at = before = 0
    for round_ in rounds:
        stretches.append(_Stretch(at, round_.begin))
        before += round_.begin - at
        for number, is_back in enumerate(back):
            stretches.append(_Stretch(round_.begin, round_.past, number, is_back))
            passed.append(PassedRound(_moved(round_, before, is_back), number))
            before += round_.past - round_.begin
        at = round_.past
    stretches.append(_Stretch(at, len(toolpath)))
    row = np.concatenate([stretch.row for stretch in stretches])
    length = [stretch.past - stretch.begin for stretch in stretches]
    number_of_row = np.repeat(np.array([stretch.number for stretch in stretches]), length)
    turned = np.repeat(np.array([stretch.is_back for stretch in stretches]), length)
    curves = _turned(toolpath.picked(row), turned)
    return PassedPath(toolpath, curves, row, number_of_row, turned, tuple(passed), _stops(toolpath, rounds, back))


def first_without_way_back(toolpath: Toolpath, rounds: Sequence[Round], back: Sequence[bool]) -> NoWayBack | None:
    """The first pass that does not begin where the one before it ended; None where all do."""
    for round_ in rounds:
        ends = toolpath.start_um[round_.begin], toolpath.end_um[round_.past - 1]
        gap_um = float(np.hypot(*(ends[1] - ends[0])))
        for number in range(1, len(back)):
            if back[number] == back[number - 1] and gap_um > CLOSED_WITHIN_UM:
                return NoWayBack(round_, number, gap_um)
    return None


def _moved(round_: Round, to: int, is_back: bool) -> Round:
    """The round with its first row at `to`, run through backwards where it is."""
    first, last, closed = round_.section
    lead = round_.past - 1 - last if is_back else first - round_.begin
    section = OffsetSection(to + lead, to + lead + last - first, closed)
    return Round(to, to + round_.past - round_.begin, section)


def _turned(curves: Curves, is_back: Bools) -> Curves:
    """Curves (n,) of which some run backwards."""
    turned = is_back[:, None]
    angle = curves.start_angle_rad + np.where(is_back, curves.sweep_rad, 0.0)
    return Curves(
        kind=curves.kind,
        start_um=np.where(turned, curves.end_um, curves.start_um),
        end_um=np.where(turned, curves.start_um, curves.end_um),
        center_um=curves.center_um,
        radius_um=curves.radius_um,
        start_angle_rad=_wrapped(angle, is_back),
        sweep_rad=np.where(is_back, -curves.sweep_rad, curves.sweep_rad),
        length_um=curves.length_um,
    )


def _wrapped(angle_rad: Floats, where: Bools) -> Floats:
    """Angles (n,), some of them brought to [−π, π]."""
    turns = np.rint(angle_rad / (2.0 * np.pi))
    return np.where(where, angle_rad - 2.0 * np.pi * turns, angle_rad)


def _stops(toolpath: Toolpath, rounds: Sequence[Round], back: Sequence[bool]) -> tuple[Stop, ...]:
    """The stops of a toolpath where they fall among the rows of its passes."""
    begin, past = np.array([(round_.begin, round_.past) for round_ in rounds], dtype=np.int64).reshape(-1, 2).T
    found: list[Stop] = []
    for stop in toolpath.stops:
        added = (len(back) - 1) * int((past - begin)[past <= stop.after].sum())
        within = np.flatnonzero((begin < stop.after) & (stop.after < past))
        if not len(within):
            found.append(stop._replace(after=stop.after + added))
            continue
        low, high = int(begin[within[0]]), int(past[within[0]])
        for number, is_back in enumerate(back):
            since = high - stop.after if is_back else stop.after - low
            found.append(stop._replace(after=low + added + number * (high - low) + since))
    return tuple(sorted(found, key=lambda stop: stop.after))
