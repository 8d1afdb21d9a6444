"""Scale and I J as they were taken, held against the path that came of them (docs/iso.md §4)."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.extents import extents
from parser.iso.centers import Agreement
from parser.iso.listing import Listing
from parser.iso.marks import Seen
from parser.iso.scale import scaled
from parser.iso.telling import Told
from parser.toolpath import Toolpath

_LEAST_UM, _MOST_UM = 500.0, 1e6  # no part is smaller than 0.5 mm, no table larger than 1 m
_UNITS = ("mm", "um", "inch")


class _Other(NamedTuple):
    """A unit in which the path has the size of a part, µm."""

    unit: str
    size_um: float


def mode_findings(listing: Listing, family: Told, toolpath: Toolpath, arcs: Agreement) -> Iterator[Finding]:
    """Findings ISO215 and ISO216: I J or unit as they are read do not fit the path."""
    seen = Seen(listing)
    if arcs.is_otherwise:
        other = "from-start" if family.profile.centers == "absolute" else "absolute"
        taken, fits = f"centres-{family.profile.centers}", f"centres-{other}"
        yield _at_first(seen, "IJ", "ISO215", arcs=arcs.arcs, taken=taken, fits=fits)
    size_um = _size_um(toolpath)
    fitting = None if family.says_unit or _LEAST_UM <= size_um <= _MOST_UM else _other(seen, family, size_um)
    if fitting and size_um:
        unit = f"unit-{fitting.unit}"
        yield _at_first(seen, "XYIJR", "ISO216", size=size_um, fits=fitting.size_um, unit=unit, name=fitting.unit)


def _other(seen: Seen, family: Told, size_um: float) -> _Other | None:
    """The first unit in which a path of a size has that of a part; None where there is none."""
    read = family.profile
    for unit in _UNITS:
        other, _ = scaled(seen, read, unit)
        times = other.integer_um / read.integer_um if seen.are_integers else other.point_um / read.point_um
        if _LEAST_UM <= size_um * times <= _MOST_UM:
            return _Other(unit, size_um * times)
    return None


def _size_um(toolpath: Toolpath) -> float:
    """The longer side of the box round all that is cut; 0 where nothing is."""
    cut = toolpath.picked(~toolpath.is_jump)
    if not len(cut):
        return 0.0
    low, high = extents(cut)
    return float((high.max(axis=0) - low.min(axis=0)).max())


def _at_first(seen: Seen, letters: str, code: str, /, **values: str | float) -> Finding:
    """Finding at the first word with one of some letters."""
    words = seen.listing.words
    word = int(np.flatnonzero(np.isin(words.letter, [ord(letter) for letter in letters]))[0])
    return seen.listing.lines.finding(code, (int(words.first[word]), int(words.past[word])), 0, **values)
