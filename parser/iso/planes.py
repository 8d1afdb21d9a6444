"""Blocks of two contours, ``lower : upper`` or the other way round: one text of each, read block by block.

The words before a colon say one contour, those behind it the other. Each contour is a program of its own: that of the
other one is blanked out, so that all words keep their places, and the text is read again.
"""

from dataclasses import replace

import numpy as np

from parser.controller_words import Compensation
from parser.dialect.reader import Assumption, Choices, without_stands
from parser.geometry.curves import CurveKind
from parser.iso.listing.lexer import read_listing
from parser.iso.listing.listing import Form, Listing
from parser.iso.numbering import checked
from parser.iso.path.motion import Moved, moved
from parser.iso.path.taper import same_rows, with_jumps
from parser.iso.profiles.profile import Profile


def with_upper_contour(listing: Listing, profile: Profile, choices: Choices, path: Moved) -> Moved:
    """The path of the lower contour with that of the upper one, where blocks have both.

    Where the two cannot be run block by block, where one leans besides, or where they compensate by different offsets,
    the wire is not known in each plane.
    """
    planes = [statement.span for statement in listing.statements if statement.form is Form.TWO_PLANES]
    if not planes:
        return path
    before, behind = _apart(listing.text, planes)
    texts = (behind, before) if profile.planes == "upper-lower" else (before, behind)
    lower, upper = (moved(checked(read_listing(text), profile), profile, choices) for text in texts)
    toolpath, other = lower.toolpath, upper.toolpath
    if not len(toolpath) and not len(other):
        return lower  # nothing moves
    leans = toolpath.leans or other.leans
    can_pair = same_rows(toolpath, other) and not (lower.damages or upper.damages)
    if leans or not can_pair or not _same_compensation(toolpath.compensation, other.compensation):
        return path._replace(lean_is_known=False)
    contour = with_jumps(other.picked(slice(None)), toolpath.kind == CurveKind.JUMP)
    source = replace(toolpath.source, text=listing.text)
    below, above = without_stands(lower.findings, other), without_stands(upper.findings, toolpath)
    found = (*below, *(each for each in above if each not in below))
    order = " : ".join(profile.planes.split("-"))
    assumed = (*lower.assumptions, Assumption("assumed-planes", order, "because-planes"))
    return lower._replace(toolpath=replace(toolpath, upper=contour, source=source), findings=found, assumptions=assumed)


def _same_compensation(lower: Compensation | None, upper: Compensation | None) -> bool:
    """Whether two contours of as many rows are offset to one side by as much, block by block, or neither is."""
    if lower is None or upper is None:
        return lower is upper
    return bool((lower.side == upper.side).all()) and np.array_equal(lower.by_um, upper.by_um, equal_nan=True)


def _apart(text: str, planes: list[tuple[int, int]]) -> tuple[str, str]:
    """The text with what stands before its colons alone, and with what stands behind them alone."""
    before, behind, since = [], [], 0
    for first, past in planes:  # of what stands before a colon, the colon included
        end = _line_end(text, past)
        before += [text[since : past - 1], " " * (end - past + 1)]
        behind += [text[since:first], " " * (past - first), text[past:end]]
        since = end
    return "".join(before) + text[since:], "".join(behind) + text[since:]


def _line_end(text: str, at: int) -> int:
    """Where the line of a place ends."""
    ends = [found for found in (text.find("\n", at), text.find("\r", at)) if found >= 0]
    return min(ends, default=len(text))
