"""Scale and I J as they were taken, held against the path that came of them (docs/iso.md §4)."""

from collections.abc import Iterator
from typing import NamedTuple

from parser.findings.facts import ReadAs
from parser.findings.findings import Finding
from parser.geometry.extents import extents
from parser.iso.path.centers import Agreement
from parser.iso.path.motion import Moved
from parser.iso.profiles.profile import Profile, profile
from parser.iso.telling.marks import Seen
from parser.iso.telling.scale import amount, scaled
from parser.iso.telling.told import Told
from parser.toolpath import Toolpath

_LEAST_UM, _MOST_UM = 500.0, 1e6  # no part is smaller than 0.5 mm, no table larger than 1 m
_FEW = 0.2  # whole numbers for each one with a point: more are a way of writing
_UNITS = ("mm", "um", "inch")


class _Fitting(NamedTuple):
    """A unit in which the path has the size of a part, µm."""

    unit: str
    size_um: float


def mode_findings(family: Told, path: Moved) -> Iterator[Finding]:
    """Findings ISO111, ISO112, ISO215 and ISO216: what was assumed, and what does not fit the path."""
    seen = family.seen
    yield from _assumptions(family)
    yield from _mixed_numbers(seen, family.profile)
    yield from _other_centers(seen, family.profile, path.agreement)
    if not family.says_unit:
        yield from _other_unit(seen, family.profile, path.toolpath)


def _assumptions(family: Told) -> Iterator[Finding]:
    """ISO112, where something was neither written nor chosen."""
    if family.is_settled:
        return
    of = family.profile
    values = {"integer": amount(of.integer_um), "point": amount(of.point_um), "centers": f"centres-{of.centers}"}
    yield Finding("ISO112", {"dialect": of.name, "distance": family.distance, **values}, fact=ReadAs())


def _mixed_numbers(seen: Seen, of: Profile) -> Iterator[Finding]:
    """ISO111 at the first length of the rarer kind, where those with a point and those without are of two scales.

    A unit that was told may give both one scale. The controller keeps its own all the same: a few whole numbers among
    many with a point are told then too.
    """
    points, integers = seen.coordinates[seen.is_pointed], seen.coordinates[~seen.is_pointed]
    if not len(points) or not len(integers):
        return
    integer_um = of.integer_um
    if integer_um == of.point_um:
        integer_um = profile(of.name).integer_um
        if integer_um == of.point_um or len(integers) > _FEW * len(points):
            return
    word = int((points if len(points) < len(integers) else integers)[0])
    scales = {"integer": amount(integer_um), "point": amount(of.point_um)}
    counts = {"integers": len(integers), "points": len(points)}
    yield seen.listing.at_word("ISO111", word, word=seen.listing.written(word), **scales, **counts)


def _other_centers(seen: Seen, of: Profile, arcs: Agreement) -> Iterator[Finding]:
    """ISO215 at the first of I and J."""
    if arcs.is_otherwise:
        fits = "from-start" if of.centers == "absolute" else "absolute"
        word = min(int(seen.listing.of(letter)[0]) for letter in "IJ")
        values = {"taken": f"centres-{of.centers}", "fits": f"centres-{fits}"}
        yield seen.listing.at_word("ISO215", word, arcs=arcs.arcs, **values)


def _other_unit(seen: Seen, of: Profile, toolpath: Toolpath) -> Iterator[Finding]:
    """ISO216 at the first length."""
    size_um = _size_um(toolpath)
    fitting = None if not size_um or _LEAST_UM <= size_um <= _MOST_UM else _fitting(seen, of, size_um)
    if fitting:
        names = {"unit": f"unit-{fitting.unit}", "name": fitting.unit}
        first = int(seen.coordinates[0])
        yield seen.listing.at_word("ISO216", first, size=size_um, fits=fitting.size_um, **names)


def _fitting(seen: Seen, read: Profile, size_um: float) -> _Fitting | None:
    """The first unit in which a path of a size has that of a part; None where there is none."""
    for unit in _UNITS:
        other, _ = scaled(seen, read, unit)
        times = other.integer_um / read.integer_um if seen.are_integers else other.point_um / read.point_um
        if _LEAST_UM <= size_um * times <= _MOST_UM:
            return _Fitting(unit, size_um * times)
    return None


def _size_um(toolpath: Toolpath) -> float:
    """The longer side of the box round all that is cut; 0 where nothing is."""
    cut = ~toolpath.is_jump
    if not cut.any():
        return 0.0
    low, high = extents(toolpath)
    return float((high[cut].max(axis=0) - low[cut].min(axis=0)).max())
