"""What is in doubt of a path: blocks whose motion is not known, and what the text leaves open of where it goes."""

from collections.abc import Iterator

import numpy as np

from parser.dialect.reader import Assumption, Damage
from parser.geometry.curves import Bools, Ints
from parser.iso.listing.listing import Form, Listing
from parser.iso.path.given import Given
from parser.iso.path.places import bare_place
from parser.iso.path.runs import Run
from parser.text.source import Span

_MOST_CALLS = 3
"""Calls that are told with their labels; of more the first ones."""


def damages(given: Given, run: Run) -> tuple[Damage, ...]:
    """Pieces that could not be read in blocks that run, calls and moves that could not be made, in file order."""
    blocks = given.listing.blocks
    lost = [*(one.span for one in given.listing.unread), *_macros_that_move(given.listing)]
    lost += [(int(blocks.first[one.block]), int(blocks.past[one.block])) for one in run.flow.faults]
    straight = run.rows.at[run.rows.turning[run.rows.arcs.sweep_rad == 0]]
    unmoved = run.flow.block[np.concatenate([straight, np.flatnonzero(run.numbers.lacks_motion)])]
    lost += [(int(blocks.first[one]), int(blocks.past[one])) for one in sorted(set(unmoved.tolist()))]
    if not lost:
        return ()
    before = _rows_before(run, len(blocks.line))
    behind = np.searchsorted(blocks.past, [first for first, _ in lost], side="right")
    after = before[behind]
    return tuple(sorted(Damage(span, int(rows)) for span, rows in zip(lost, after, strict=True) if rows >= 0))


def _macros_that_move(listing: Listing) -> Iterator[Span]:
    """Places of macros but those that only set a variable: they move the wire, or choose which blocks run."""
    for one in listing.statements:
        if one.form is Form.MACRO and listing.text[one.span[0]] != "#":
            yield one.span


def _rows_before(run: Run, count: int) -> Ints:
    """(count + 1,) rows before each block first runs; −1 where it never does, all rows behind the last block."""
    before = np.full(count + 1, -1, dtype=np.int64)
    backwards = run.flow.block[::-1]
    before[backwards] = np.searchsorted(run.rows.at, np.arange(len(backwards))[::-1])
    before[count] = len(run.rows.at)
    return before


def assumptions(given: Given, run: Run) -> tuple[Assumption, ...]:
    """What was taken where the text leaves it open."""
    told = [*_call_targets(given, run)]
    if given.listing.blocks.is_skipped[run.flow.block].any():
        told.append(Assumption("assumed-skips", "/", "because-skips-run"))
    if run.offsets and run.offsets.assumed:
        told.append(Assumption("assumed-register", run.offsets.assumed, "because-only-register"))
    if run.place.is_threaded.any():
        told.append(Assumption("assumed-threading", _text(given, run, run.place.is_threaded), "because-behind-stop"))
    is_bare = bare_place(given)[run.flow.block]
    if is_bare.any():
        told.append(Assumption("assumed-place", "X0 Y0", "because-bare"))
    if _starts_unnamed(run):
        told.append(Assumption("assumed-start", "X0 Y0", "because-no-start"))
    return tuple(told)


def _call_targets(given: Given, run: Run) -> Iterator[Assumption]:
    """Which label each call was taken to name: families name programs or blocks."""
    listing = given.listing
    calls = [f"{listing.written(call.name)} → {listing.written(call.label)}" for call in run.flow.calls]
    targets = list(dict.fromkeys(calls))
    if targets:
        more = ", …" if len(targets) > _MOST_CALLS else ""
        why = "because-calls-programs" if given.profile.calls[0] == "program" else "because-calls-labels"
        yield Assumption("assumed-calls", ", ".join(targets[:_MOST_CALLS]) + more, why)


def _text(given: Given, run: Run, chosen: Bools) -> str:
    """The first of some running blocks as written."""
    block = run.flow.block[int(np.argmax(chosen))]
    blocks = given.listing.blocks
    return given.listing.text[int(blocks.first[block]) : int(blocks.past[block])]


def _starts_unnamed(run: Run) -> bool:
    """Whether the first motion goes to a place, cutting, from one that nothing names."""
    first = run.rows.at[:1]
    named = run.numbers.names[: first[0]].any() if len(first) else True
    return bool(not named and run.mode.is_absolute[first].any() and run.mode.motion[first].any())
