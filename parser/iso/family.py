"""Which family a listing was written for, and all that had to be assumed of scale and modes (docs/iso.md §4, §6).

The scale of the numbers of a listing: what 1 is, with and without a point (docs/iso.md §4).

Scale and I J as they were taken, held against the path that came of them (docs/iso.md §4).
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.dialect.reader import Assumption, Choices, ChosenDialect
from parser.findings.codes import Severity
from parser.findings.findings import Finding, ReadAs
from parser.geometry.curves import extents
from parser.iso.listing.listing import Listing
from parser.iso.marks import DIGITS_IN_MM, MarksSeen, mark_of
from parser.iso.path.arcs import Agreement
from parser.iso.path.motion import Moved
from parser.iso.profiles.profile import Profile, profile
from parser.toolpath import Toolpath
from parser.units import UM_PER_MM

UM_PER_INCH = 25.4 * UM_PER_MM
_STEP_IN = 1e-4  # inch, of numbers without a point
_MOST_OFFSET_IN = 0.03  # offsets of wires are 0.05 to 0.35 mm, 0.002 to 0.014 inch
_DIGITS_IN_INCH = 4


def scaled(seen: MarksSeen, base: Profile, unit: str) -> tuple[Profile, str]:
    """A profile with the scale of a listing, and the term of what speaks for inches where they were told by it.

    `unit` is ``um``, ``mm`` or ``inch`` as told for the program, or empty: the family tells it then, and in a family
    that writes both mm and inches the numbers themselves.
    """
    inches = _inches(seen) if base.may_be_inch and not unit else ""
    if unit == "inch" or inches:
        return _in_inches(seen, base), inches
    if unit:
        integer_um = UM_PER_MM if unit == "mm" else 1.0
        base = replace(base, integer_um=integer_um, register_integer_um=integer_um)
    return replace(base, resolution_um=base.resolution_um * _finer(seen, DIGITS_IN_MM)), ""


def amount(length_um: float) -> str:
    """What a number of 1 is, for people: ``0.001 mm``, ``1 inch``."""
    inches = length_um / UM_PER_INCH
    if inches in {1.0, _STEP_IN}:
        return f"{inches:g} inch"
    return f"{length_um / UM_PER_MM:g} mm"


def _inches(seen: MarksSeen) -> str:
    """Term of what speaks for inches in a family that writes both units; empty where nothing does."""
    offset = seen.greatest_setting
    if offset:
        return "because-small-offsets" if offset < _MOST_OFFSET_IN else ""
    return "because-four-digits" if seen.decimals > DIGITS_IN_MM else ""


def _in_inches(seen: MarksSeen, base: Profile) -> Profile:
    step_um = _STEP_IN * UM_PER_INCH
    return replace(
        base,
        integer_um=step_um,
        point_um=UM_PER_INCH,
        register_integer_um=step_um,
        register_point_um=UM_PER_INCH,
        resolution_um=step_um * _finer(seen, _DIGITS_IN_INCH),
        step_um=step_um / 10,  # real programs have offsets of five digits
    )


def _finer(seen: MarksSeen, digits: int) -> float:
    """The step of numbers that need more digits than usual, as a part of the usual one; not where some are integers."""
    return 10.0 ** min(digits - seen.decimals, 0) if seen.is_pointed.all() else 1.0


_G = {"absolute": "G90", "incremental": "G91"}
_ASSUMED_CENTERS, _ASSUMED_DISTANCE = "assumed-centres", "assumed-distance"
_CHOSEN = "because-chosen"
_DISTANCE, _CENTERS, _INCH, _METRIC = (90.0, 91.0), (90.1, 91.1), (20.0, 70.0), (21.0, 71.0)
_INCH_WORDS = ("G20", "G70")


class ToldProfile(NamedTuple):
    """The profile that a listing is read by, its scale and modes those that were taken; and what was assumed.

    Attributes
    ----------
    profile
        Of the family.
    assumptions
        What the text leaves open, in the order in which it is told; also what was chosen in its place.
    seen
        What stands in the listing.
    distance
        ``G90`` or ``G91``, in force at the first motion.
    says_centers, says_unit
        Whether the text itself says what I and J are, and its unit; or the unit was named for it.
    dialect
        Whose profile it is, before the scale and the modes of this listing.
    """

    profile: Profile
    assumptions: tuple[Assumption, ...]
    seen: MarksSeen
    distance: str
    says_centers: bool
    says_unit: bool
    dialect: ChosenDialect

    @property
    def is_chosen(self) -> bool:
        """Whether the family was named, not told by marks."""
        return all(assumption.what != "assumed-dialect" for assumption in self.assumptions)

    @property
    def is_settled(self) -> bool:
        """Whether all of it was written or chosen."""
        return all(assumption.why == _CHOSEN for assumption in self.assumptions)


def profile_told(listing: Listing, choices: Choices) -> ToldProfile:
    """The profile of a listing: as chosen, or by its marks; ``common`` where nothing tells."""
    seen = MarksSeen(listing)
    mark = None if choices.dialect else mark_of(seen)
    dialect = choices.dialect or (mark.dialect if mark else "common")
    base = profile(dialect)
    first = _first_move(listing)
    unit_word = _last_word(listing, (*_INCH, *_METRIC), seen.first_length)
    if unit_word:
        base = replace(base, may_be_inch=False)
    of, inches = scaled(seen, base, choices.unit or ("inch" if unit_word in _INCH_WORDS else ""))
    habit = _CHOSEN if choices.dialect else "because-profile"
    distance = _last_word(listing, _DISTANCE, first)
    says_centers = bool(_last_word(listing, _CENTERS, len(listing.blocks.line)))
    says_unit = bool(choices.unit or (unit_word and seen.is_pointed.all()))  # what integers are, no word says
    assumed = []
    if not choices.dialect:
        assumed.append(Assumption("assumed-dialect", of.name, mark.why if mark else "because-none"))
    if len(seen.coordinates) and not says_unit:
        assumed.append(Assumption("assumed-unit", _unit(seen, of), inches or habit))
    if not distance:
        assumed.append(Assumption(_ASSUMED_DISTANCE, _G[of.distance], habit))
    if not says_centers and (seen.has("I") or seen.has("J")):
        assumed.append(Assumption(_ASSUMED_CENTERS, of.centers, habit))
    return ToldProfile(of, tuple(assumed), seen, distance or _G[of.distance], says_centers, says_unit, dialect)


def in_other_distance(family: ToldProfile) -> ToldProfile | None:
    """The family with the other of G90 and G91 at the start, as arcs tell it; None where it was written or chosen."""
    if family.is_chosen or all(assumption.what != _ASSUMED_DISTANCE for assumption in family.assumptions):
        return None
    of = replace(family.profile, distance="incremental" if family.profile.distance == "absolute" else "absolute")
    assumptions = tuple(
        Assumption(assumption.what, _G[of.distance], "because-arcs")
        if assumption.what == _ASSUMED_DISTANCE
        else assumption
        for assumption in family.assumptions
    )
    return family._replace(profile=of, assumptions=assumptions, distance=_G[of.distance])


def reread(family: ToldProfile, arcs: Agreement) -> ToldProfile:
    """The family with the reading of I J in which the arcs agree, where it was neither written nor chosen."""
    of, why = family.profile, arcs.why
    if arcs.is_otherwise:
        if family.is_chosen or family.says_centers:
            return family
        of = replace(of, centers="from-start" if of.centers == "absolute" else "absolute")
        why = "because-arcs"
    assumptions = tuple(
        Assumption(assumption.what, of.centers, why) if assumption.what == _ASSUMED_CENTERS and why else assumption
        for assumption in family.assumptions
    )
    return family._replace(profile=of, assumptions=assumptions)


def _unit(seen: MarksSeen, of: Profile) -> str:
    """The scale of the numbers that there are: integers, numbers with a point, or both."""
    taken = []
    if not seen.is_pointed.all():
        taken.append(f"1 = {amount(of.integer_um)}")
    if seen.is_pointed.any():
        taken.append(f"1. = {amount(of.point_um)}")
    return ", ".join(taken)


def _last_word(listing: Listing, numbers: tuple[float, ...], block: int) -> str:
    """The last of some G words that stands in or before a block, ``G90``; empty where there is none."""
    word = listing.of("G")
    value = listing.words.value[word]
    said = value[np.isin(value, numbers) & (listing.words.block[word] <= block)]
    return f"G{said[-1]:g}" if len(said) else ""


def _first_move(listing: Listing) -> int:
    """The first block with X or Y that is no G92; behind all blocks where there is none."""
    letter, value = listing.words.letter, listing.words.value
    places = listing.blocks_of(np.flatnonzero((letter == ord("X")) | (letter == ord("Y"))))
    named = listing.blocks_of(np.flatnonzero((letter == ord("G")) & (value == 92.0)))
    moving = np.flatnonzero(places & ~named)
    return int(moving[0]) if len(moving) else len(listing.blocks.line)


_LEAST_UM, _MOST_UM = 500.0, 1e6  # no part is smaller than 0.5 mm, no table larger than 1 m
_KERF_UM, _BEYOND_UM = 100.0, 1e7  # the thinnest wire in common use is 0.1 mm wide
_FEW = 0.2  # whole numbers for each one with a point: more are a way of writing
_UNITS = ("mm", "um", "inch")


class _Fitting(NamedTuple):
    """A unit in which the path has the size of a part, µm."""

    unit: str
    size_um: float


def mode_findings(family: ToldProfile, path: Moved) -> Iterator[Finding]:
    """Findings ISO111, ISO112, ISO215 and ISO216: what was assumed, and what does not fit the path."""
    seen = family.seen
    yield from _assumptions(family)
    yield from _mixed_numbers(seen, family.profile, family.dialect)
    yield from _other_centers(seen, family.profile, path.agreement)
    if not family.says_unit:
        yield from _other_unit(seen, family.profile, path.toolpath)


def _assumptions(family: ToldProfile) -> Iterator[Finding]:
    """ISO112, where something was neither written nor chosen."""
    if family.is_settled:
        return
    of = family.profile
    values = {"integer": amount(of.integer_um), "point": amount(of.point_um), "centers": f"centres-{of.centers}"}
    yield Finding("ISO112", {"dialect": of.name, "distance": family.distance, **values}, fact=ReadAs())


def _mixed_numbers(seen: MarksSeen, of: Profile, dialect: ChosenDialect) -> Iterator[Finding]:
    """ISO111 at the first length of the rarer kind, where those with a point and those without are of two scales.

    A unit that was told may give both one scale. The controller keeps its own all the same: a few whole numbers among
    many with a point are told then too.
    """
    points, integers = seen.coordinates[seen.is_pointed], seen.coordinates[~seen.is_pointed]
    if not len(points) or not len(integers):
        return
    integer_um = of.integer_um
    if integer_um == of.point_um:
        integer_um = profile(dialect).integer_um
        if integer_um == of.point_um or len(integers) > _FEW * len(points):
            return
    word = int((points if len(points) < len(integers) else integers)[0])
    scales = {"integer": amount(integer_um), "point": amount(of.point_um)}
    counts = {"integers": len(integers), "points": len(points)}
    yield seen.listing.at_word("ISO111", word, word=seen.listing.written(word), **scales, **counts)


def _other_centers(seen: MarksSeen, of: Profile, arcs: Agreement) -> Iterator[Finding]:
    """ISO215 at the first of I and J."""
    if arcs.is_otherwise:
        fits = "from-start" if of.centers == "absolute" else "absolute"
        word = min(int(seen.listing.of(letter)[0]) for letter in "IJ")
        values = {"taken": f"centres-{of.centers}", "fits": f"centres-{fits}"}
        yield seen.listing.at_word("ISO215", word, arcs=arcs.arcs, **values)


def _other_unit(seen: MarksSeen, of: Profile, toolpath: Toolpath) -> Iterator[Finding]:
    """ISO216 at the first length; an error where all of the path would lie within a kerf, or be beyond any table."""
    size_um = _size_um(toolpath)
    fitting = None if not size_um or _LEAST_UM <= size_um <= _MOST_UM else _fitting(seen, of, size_um)
    if fitting:
        names = {"unit": f"unit-{fitting.unit}", "name": fitting.unit}
        first = int(seen.coordinates[0])
        found = seen.listing.at_word("ISO216", first, size=size_um, fits=fitting.size_um, **names)
        yield found._replace(graver=None if _KERF_UM <= size_um <= _BEYOND_UM else Severity.ERROR)


def _fitting(seen: MarksSeen, read: Profile, size_um: float) -> _Fitting | None:
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
