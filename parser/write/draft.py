"""A draft: what is to be written, whatever the language; from a toolpath, or made by whoever has curves."""

import re
from dataclasses import dataclass, fields, replace
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.told.compensation import Compensation
from parser.told.step_words import StepWords
from parser.toolpath import Stop, Toolpath
from parser.write.events import Event

_PLACED = re.compile(r"\s*(?:N\s*\d+\s*)?(?:Start|PSET|.*G\s*92(?!\d))", re.IGNORECASE)
_STAYS_UM = 1.5
"""An arc whose radii at start and end differ by no more, as rounding both to whole µm makes it, keeps its centre."""


@dataclass(frozen=True, slots=True, eq=False)
class Draft:
    """What is to be written, n rows.

    Attributes
    ----------
    curves
        Lines, arcs and jumps; each begins where the one before it ends.
    stops
        Pauses and the end; no two at one place.
    is_placed
        (n,) jumps whose end is named as a place, and not gone to: the wire is threaded there by hand.
    told_um
        (n, 2) ways from the starts of arcs to their centres that are to be written so; NaN where the centre may move
        until the arc ends where it should.
    words
        The words of a counting controller that are to be written; None where they are to be told.
    compensation
        The controller's offset that is to be written; None where it has none.
    events
        What is switched where it stands, in ISO.
    is_meant
        Whether the curves are what is meant, and not what a program made of it: the nearest whole numbers are written
        then, in place of those that a CAM would have written.
    """

    curves: Curves
    stops: tuple[Stop, ...]
    is_placed: Bools
    told_um: Floats
    words: StepWords | None = None
    compensation: Compensation | None = None
    is_meant: bool = False
    events: tuple[Event, ...] = ()

    def __len__(self) -> int:
        return len(self.curves)

    def without_compensation(self) -> "Draft":
        """The same path, with nothing said of the controller's offset."""
        return replace(self, compensation=None)


class Written(NamedTuple):
    """A text.

    Attributes
    ----------
    text
        All of it.
    row
        (m,) row of the draft that each of its blocks is of; a row may make no block, or some.
    ramp_ms
        Acceleration time that it sets, as its shortest blocks ask for it; 0 where it leaves that to the card.
    """

    text: str
    row: Ints
    ramp_ms: int = 0


def draft_of(toolpath: Toolpath) -> Draft:
    """The draft of a toolpath: its words where it has such, the centres of arcs as they are told."""
    pauses = {stop.after: stop for stop in toolpath.stops if stop.kind == "pause"}
    ends = [stop for stop in toolpath.stops if stop.kind == "end"]
    return Draft(
        curves=Curves(**{field.name: getattr(toolpath, field.name) for field in fields(Curves)}),
        stops=(*(stop for after, stop in sorted(pauses.items()) if 0 < after < len(toolpath)), *ends[:1]),
        is_placed=_placed(toolpath),
        told_um=_told(toolpath),
        words=toolpath.words,
        compensation=toolpath.compensation,
    )


def _placed(toolpath: Toolpath) -> Bools:
    placed = np.zeros(len(toolpath), dtype=np.bool_)
    for row in np.flatnonzero(toolpath.is_jump).tolist():
        placed[row] = bool(_PLACED.match(toolpath.source.block_text(row)))
    return placed


def _told(toolpath: Toolpath) -> Floats:
    """Ways to the centres: of blocks with words exactly as they say, else as told where start and end agree."""
    nowhere = np.full((len(toolpath), 2), np.nan)
    if toolpath.words is not None:
        out = np.column_stack([toolpath.words.x_um, toolpath.words.y_um]) * toolpath.words.signs
        return np.where(toolpath.is_arc[:, None], -out, nowhere)
    if toolpath.told_center_um is None:
        return nowhere
    by = toolpath.told_center_um - toolpath.start_um
    back = toolpath.told_center_um - toolpath.end_um
    differ = np.abs(np.hypot(by[:, 0], by[:, 1]) - np.hypot(back[:, 0], back[:, 1]))
    return np.where((toolpath.is_arc & (differ <= _STAYS_UM))[:, None], by, nowhere)


def picked(draft: Draft, row: Ints) -> Draft:
    """The rows `row` (m,) of a draft, rising; a row may be there more than once. Stops keep their places among them."""
    compensation = draft.compensation and replace(
        draft.compensation,
        side=draft.compensation.side[row],
        by_um=draft.compensation.by_um[row],
        register=tuple(draft.compensation.register[at] for at in row.tolist()),
    )
    words = draft.words and StepWords(*(getattr(draft.words, name)[row] for name in StepWords.__slots__))
    stops = (stop._replace(after=int(np.searchsorted(row, stop.after))) for stop in draft.stops)
    columns = draft.curves.picked(row), tuple(stops), draft.is_placed[row], draft.told_um[row]
    return Draft(*columns, words, compensation, draft.is_meant)
