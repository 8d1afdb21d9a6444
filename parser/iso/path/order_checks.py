"""Checks of the order of blocks: ends, calls, what never runs, coordinates named in the middle (docs/iso.md §7)."""

import re
from collections.abc import Iterator

import numpy as np

from parser.findings.findings import Edit, Finding, Value
from parser.geometry.curves import Ints
from parser.iso.listing.listing import Listing
from parser.iso.path.flow import Flow, GivenColumns, idle
from parser.iso.path.places import SET_PLACE, Places, bare_place
from parser.text.encoding import written_end
from parser.text.source import Span

_INK = re.compile(r"[^\s%\x00-\x1f][^\r\n]*")
_MOTION_LETTERS = [ord(letter) for letter in "XYIJR"]


def order_findings(given: GivenColumns, run: Flow, side: Ints, place: Places, at: Ints) -> Iterator[Finding]:
    """All that is wrong with the order of blocks; `side` (e,) of the running blocks, `at` (n,) those that move."""
    yield from _without_end(given.listing, run)
    yield from _crowded_ends(given)
    yield from _calls(given.listing, run)
    yield from _never_run(given, run)
    yield from _behind_tape(given.listing)
    yield from _named_places(given, run, place)
    yield from _bare_places(given, run)
    yield from _while_compensated(given, run, side, at)


def _without_end(listing: Listing, run: Flow) -> Iterator[Finding]:
    """ISO109; the mend is certain where the text simply stops."""
    if run.left == "end" or not len(run.block):
        return
    last = int(run.block[-1])
    line = int(listing.blocks.line[last])
    _, past = listing.lines.bounds(line)
    past = min(past, written_end(listing.text))
    newline = "\r\n" if "\r\n" in listing.text else "\n"
    is_certain = run.left == "text" and not run.faults and past <= listing.tape_end
    edits = (Edit(past, past, f"{newline}M02"),) if is_certain else ()
    span = (int(listing.blocks.first[last]), int(listing.blocks.past[last]))
    yield listing.lines.finding("ISO109", span)._replace(edits=edits)


def _crowded_ends(given: GivenColumns) -> Iterator[Finding]:
    """ISO208: one finding a block, at the word that is too many."""
    words = given.listing.words
    stops, ends = given.m_words("stop", "end"), given.m_words("end")
    _, first = np.unique(words.block[stops], return_index=True)
    later = np.delete(stops, first)
    moving = np.flatnonzero(np.isin(words.letter, _MOTION_LETTERS))
    end_of = np.full(len(given.listing.blocks.line), len(words.letter), dtype=np.int64)
    end_of[words.block[ends[::-1]]] = ends[::-1]
    behind = moving[moving > end_of[words.block[moving]]]
    wrong = np.sort(np.concatenate([later, behind]))
    _, first = np.unique(words.block[wrong], return_index=True)
    for word in wrong[first].tolist():
        yield _of_span(given.listing, "ISO208", (int(words.first[word]), int(words.past[word])))


def _calls(listing: Listing, run: Flow) -> Iterator[Finding]:
    """ISO400."""
    for fault in run.faults:
        yield _at(listing, "ISO400", fault.block, what=fault.why)


def _never_run(given: GivenColumns, run: Flow) -> Iterator[Finding]:
    """ISO401 at subprograms that nothing calls, ISO108 at other blocks that nothing reaches: once a stretch.

    A subprogram with the label of one that runs is a label that is used twice (ISO121), and nothing besides.
    """
    words, never = given.listing.words, idle(given, run)
    label, returns = np.maximum(given.word("N"), given.word("O")), given.m("return")
    starts = np.flatnonzero(never & ~np.concatenate([[False], never[:-1] & ~returns[:-1]]))
    called = run.main_end + np.flatnonzero(~never[run.main_end :])
    known = set(words.value[label[called][label[called] >= 0]].tolist())
    for first, past in zip(starts.tolist(), np.append(starts, len(never))[1:].tolist(), strict=True):
        word = int(label[first])
        if word < 0 or not (returns & never)[first:past].any():
            yield _at(given.listing, "ISO108", first)
        elif float(words.value[word]) not in known:
            yield _of_span(given.listing, "ISO401", (int(words.first[word]), int(words.past[word])))


def _behind_tape(listing: Listing) -> Iterator[Finding]:
    """ISO108 at the first text behind the ``%`` that ends the tape."""
    text = _INK.search(listing.text, listing.tape_end)
    if text:
        yield _of_span(listing, "ISO108", text.span())


def _named_places(given: GivenColumns, run: Flow, place: Places) -> Iterator[Finding]:
    """ISO303: a G92 that names another place than the wire is at, with no stop to thread it there."""
    for at in _first_runs(run, np.flatnonzero(place.is_rebased)).tolist():
        by_x, by_y = (place.shift_um[at - 1] - place.shift_um[at]).tolist()
        yield _at(given.listing, "ISO303", int(run.block[at]), x=by_x, y=by_y)


def _bare_places(given: GivenColumns, run: Flow) -> Iterator[Finding]:
    """ISO113: a G92 that names no place, with the place that it was taken for as its mend, written as others are.

    A place of which no number can be read (ISO102) is no bare one: nothing is mended there. Of two in one block
    (ISO200) neither has a mend, which would write each letter twice.
    """
    words = given.listing.words
    written = words.decimals[np.isin(words.letter, _MOTION_LETTERS)]
    place = " X0. Y0." if len(written) and (written >= 0).all() else " X0 Y0"
    ran = np.zeros(len(given.listing.blocks.line), dtype=np.bool_)
    ran[run.block] = True
    ran &= ~given.listing.blocks.is_damaged
    names = given.listing.of("G")
    names = names[(words.value[names] * 10 == SET_PLACE) & (bare_place(given) & ran)[words.block[names]]]
    in_block = np.bincount(words.block[names], minlength=len(ran))[words.block[names]]
    for word, number in zip(names.tolist(), in_block.tolist(), strict=True):
        past = int(words.past[word])
        finding = _of_span(given.listing, "ISO113", (int(words.first[word]), past))
        yield finding if number > 1 else finding._replace(edits=(Edit(past, past, place),))


def _while_compensated(given: GivenColumns, run: Flow, side: Ints, at: Ints) -> Iterator[Finding]:
    """ISO511: coordinates named anew while the wire is beside the contour."""
    names = (given.g(SET_PLACE) | (given.group("system") >= 0))[run.block]
    moved = np.zeros(len(side), dtype=np.bool_)
    moved[at] = side[at] != 0
    was_on = np.concatenate([[0], side[:-1]]) != 0
    since = np.maximum.accumulate(np.where(was_on, -1, np.arange(len(side))))
    total = np.concatenate([[0], np.cumsum(moved)])
    is_beside = was_on & (side != 0) & (total[:-1] > total[np.maximum(since, 0)])
    for each_run in _first_runs(run, np.flatnonzero(names & is_beside)).tolist():
        yield _at(given.listing, "ISO511", int(run.block[each_run]))


def _first_runs(run: Flow, at: Ints) -> Ints:
    """Of the running blocks `at` those that run for the first time among them."""
    _, first = np.unique(run.block[at], return_index=True)
    return at[np.sort(first)]


def _at(listing: Listing, code: str, block: int, /, **values: Value) -> Finding:
    return _of_span(listing, code, (int(listing.blocks.first[block]), int(listing.blocks.past[block])), **values)


def _of_span(listing: Listing, code: str, span: Span, /, **values: Value) -> Finding:
    return listing.lines.finding(code, span, 0, text=listing.text[slice(*span)], **values)
