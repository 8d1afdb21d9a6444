"""Technology files: what a wire does in a material at a height of the work, pass by pass, each figure with its ±.

A file holds what somebody measured, or read in a maker's table; each cut says where it comes from and how sure it is.
Between the heights that it knows, figures are interpolated; beyond them they stay as at the last one, and the interval
opens. An interval is what 90 % of cuts fall into.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Final, Literal, NamedTuple, get_args

import numpy as np

from parser.findings.errors import SettingsError
from parser.units import mm
from sim.setup.part import FEED_MM_MIN, THICKNESS_MM
from sim.setup.toml.keys import Key, Section, WrittenSection
from sim.setup.toml.kinds import AS_IS, MM_AS_UM, Name, Number, OneOf, Text, Whole
from sim.setup.toml.reader import AREA_RATE_MM2_MIN, Bound, load_toml, tables
from sim.setup.wire import WIRE_DIAMETER_MM, WIRE_LAG_UM

LEVEL: Final = 0.9
"""Share of cuts that fall into an interval."""
Grade = Literal["measured", "maker", "assumed"]
"""Where a figure comes from: measured on this machine, a maker's table, or nobody who measured it."""
_GAP_UM: Final = Bound(-50.0, 500.0)
_SHARE: Final = Bound(0.0, 0.99)
_MOST_CUTS: Final = 10_000
_MOST_PASSES: Final = Bound(1, 20)
_SAME_WIRE_UM: Final = 1.0
GAP_WITHIN_UM: Final[Mapping[Grade, float]] = {"measured": 2.0, "maker": 3.0, "assumed": 5.0}
"""Half the interval of a gap of which a file says none (assumed)."""
RATE_WITHIN: Final[Mapping[Grade, float]] = {"measured": 0.15, "maker": 0.17, "assumed": 0.40}
"""The same of a feed, as a share of it.

Cuts of one shop scatter by 9 % (rms, 15 % at most); a maker's table of 0.005 in/min steps is rounded by up to 17 %.
Assumed: a constant area rate, set at 40 mm, was 69 % and 50 % off at a third and at four times the height.
"""
LAG_WITHIN: Final[Mapping[Grade, float]] = {"measured": 0.20, "maker": 0.50, "assumed": 0.99}
"""The same of a lag (assumed)."""
_BETWEEN: Final = 0.15
"""How far a feed may be off halfway between two heights of which one is three times the other; less where they lie
nearer. Interpolating a maker's table over such steps was off by 9 % rms, and 15 % at most."""
_BEYOND_RATE: Final = 0.46
"""How much a feed may be off at half the least height that is known, or twice the greatest: measured on a table."""
_BEYOND_GAP: Final = 0.09
"""The same of a gap: a gap of 43 µm at 12.7 mm was 58 µm at 152 mm, 9 % more each time the height doubles."""
_BEYOND_LAG: Final = 1.0
"""The same of a lag: in the middle of a wire that is loaded all along it goes as the height squared, q h² / (8 T)."""


class Figure(NamedTuple):
    """A number with the interval that 90 % of cuts fall into, and where it comes from."""

    value: float
    least: float
    most: float
    grade: Grade
    source: str


class PassTechnology(NamedTuple):
    """What one pass does; None where nobody says.

    Attributes
    ----------
    number
        From 1.
    gap_um
        Spark gap on one side.
    feed_mm_min
        Feed along the path.
    lag_um
        How far the wire bows back behind its guides; the least is 0 or more.
    offset_um
        Distance of the wire's centre from the edge that the maker has.
    roughness_um
        Ra of the edge.
    """

    number: int
    gap_um: Figure
    feed_mm_min: Figure | None
    lag_um: Figure | None
    offset_um: Figure | None
    roughness_um: Figure | None

    @property
    def time_ratios(self) -> tuple[float, float]:
        """By which ratios the time of the pass may be shorter and longer; as assumed where nobody says its feed."""
        if self.feed_mm_min is None:
            return 1.0 / (1.0 + RATE_WITHIN["assumed"]), 1.0 + RATE_WITHIN["assumed"]
        return self.feed_mm_min.value / self.feed_mm_min.most, self.feed_mm_min.value / self.feed_mm_min.least


class Cut(NamedTuple):
    """One row of a technology file: what a pass does at one height. None where it says nothing."""

    material: str
    wire_um: float
    height_mm: float
    number: int
    gap_um: float
    gap_within_um: float | None
    feed_mm_min: float | None
    area_rate_mm2_min: float | None
    rate_within: float | None
    lag_um: float | None
    lag_within_um: float | None
    offset_um: float | None
    roughness_um: float | None
    grade: Grade | None
    source: str | None


class Technology(NamedTuple):
    """A technology file: its name, the grade and the source of cuts that say none of their own, and its cuts."""

    name: str
    grade: Grade
    source: str
    cuts: tuple[Cut, ...]
    name_zh: str | None = None

    @property
    def materials(self) -> tuple[str, ...]:
        """The materials that it knows, in order, each as it is first written."""
        written: dict[str, str] = {}
        for cut in self.cuts:
            written.setdefault(cut.material.casefold(), cut.material)
        return tuple(written.values())


def assumed_pass(gap_um: float, feed_mm_min: float, lag_um: float, source: str) -> PassTechnology:
    """The only pass of a machine and a wire without a technology: all of it is assumed; a lag of 0 is not known."""

    def figure(value: float, least: float, most: float) -> Figure:
        return Figure(value, least, most, "assumed", source)

    within, ratio, of_lag = GAP_WITHIN_UM["assumed"], 1.0 + RATE_WITHIN["assumed"], LAG_WITHIN["assumed"]
    gap = figure(gap_um, gap_um - within, gap_um + within)
    feed = figure(feed_mm_min, feed_mm_min / ratio, feed_mm_min * ratio)
    lag = figure(lag_um, (1.0 - of_lag) * lag_um, (1.0 + of_lag) * lag_um) if lag_um else None
    return PassTechnology(1, gap, feed, lag, None, None)


class Choice(NamedTuple):
    """What of a technology is asked for: a material, a wire and a height of the work."""

    material: str
    wire_um: float
    height_mm: float


_GRADE = OneOf(get_args(Grade))
TECHNOLOGY = Section(
    "technology",
    (
        Key("name", Name()),
        Key("name_zh", Name(), default=None),
        Key("grade", _GRADE, default="assumed"),
        Key("source", Text(), default="not given"),
    ),
)
CUT = Section(
    "cut",
    (
        Key("material", Name()),
        Key("wire_mm", Number(WIRE_DIAMETER_MM, "mm", MM_AS_UM), "wire_um"),
        Key("height_mm", Number(THICKNESS_MM, "mm")),
        Key("pass", Whole(_MOST_PASSES), "number", default=1),
        Key("gap_um", Number(_GAP_UM, "µm")),
        Key("gap_within_um", Number(Bound(0.0, 500.0), "µm"), default=None),
        Key("feed_mm_min", Number(FEED_MM_MIN, "mm/min", AS_IS), default=None),
        Key("area_rate_mm2_min", Number(AREA_RATE_MM2_MIN, "mm²/min"), default=None),
        Key("rate_within", Number(_SHARE), default=None),
        Key("lag_um", Number(WIRE_LAG_UM, "µm"), default=None),
        Key("lag_within_um", Number(WIRE_LAG_UM, "µm"), default=None),
        Key("offset_mm", Number(Bound(0.0001, 10.0), "mm", MM_AS_UM), "offset_um", default=None),
        Key("ra_um", Number(Bound(0.001, 100.0), "µm"), "roughness_um", default=None),
        Key("grade", _GRADE, default=None),
        Key("source", Text(), default=None),
    ),
    fills="cuts",
    form="list",
)
SECTIONS: Final = (TECHNOLOGY, CUT)
"""Sections of a technology file."""


def load_technology(path: Path) -> Technology:
    """A technology file. Raises FileUnreadableError, and SettingsError with file and key."""
    content, where = load_toml(path), str(path)
    unknown = sorted(content.keys() - {section.name for section in SECTIONS})
    if unknown:
        raise SettingsError("technology-section", where=where, found=unknown[0])
    head = TECHNOLOGY.read_in(content, where)
    rows = tables(content, CUT.name, where)
    if not 0 < len(rows) <= _MOST_CUTS:
        raise SettingsError("technology-cuts", where=where, most=_MOST_CUTS)
    cuts = tuple(_cut(row, f"{where}: [[cut]] {at}") for at, row in enumerate(rows, start=1))
    seen: dict[tuple[str, float, float, int], int] = {}
    for at, cut in enumerate(cuts, start=1):
        key = (cut.material.casefold(), cut.wire_um, cut.height_mm, cut.number)
        if key in seen:
            raise SettingsError("technology-twice", where=where, at=at, before=seen[key])
        seen[key] = at
    return Technology(cuts=cuts, **head)


def _cut(row: Mapping[str, Any], where: str) -> Cut:
    cut = Cut(**CUT.read(row, where))
    if cut.feed_mm_min is not None and cut.area_rate_mm2_min is not None:
        raise SettingsError("feed-and-area-rate", where=where)
    if cut.wire_um + 2.0 * cut.gap_um <= 0.0:
        raise SettingsError("wire-cuts-no-kerf", diameter_um=cut.wire_um, spark_gap_um=cut.gap_um)
    return cut


def technology_sections(technology: Technology) -> list[WrittenSection]:
    """Sections of the technology file that says the same."""
    return [written for section in SECTIONS for written in section.written(technology)]


def worst_grade(grades: Iterable[Grade]) -> Grade:
    """The least sure of some grades."""
    return max(grades, key=get_args(Grade).index)


def passes_at(technology: Technology, choice: Choice) -> tuple[PassTechnology, ...]:
    """What each pass does that a technology knows, in order, at a height of the work.

    SettingsError where it knows nothing of the material or of the wire.
    """
    of_material = [cut for cut in technology.cuts if cut.material.casefold() == choice.material.casefold()]
    if not of_material:
        known = ", ".join(technology.materials)
        raise SettingsError("technology-material", name=technology.name, material=choice.material, known=known)
    of_wire = [cut for cut in of_material if abs(cut.wire_um - choice.wire_um) <= _SAME_WIRE_UM]
    if not of_wire:
        known = ", ".join(f"{mm(wire_um):g}" for wire_um in sorted({cut.wire_um for cut in of_material}))
        wire_mm = mm(choice.wire_um)
        raise SettingsError(
            "technology-wire", name=technology.name, known=known, material=choice.material, wire_mm=wire_mm
        )
    numbers = sorted({cut.number for cut in of_wire})
    at_heights = ([cut for cut in of_wire if cut.number == number] for number in numbers)
    return tuple(
        _pass_at(number, sorted(cuts, key=lambda cut: cut.height_mm), choice.height_mm, technology)
        for number, cuts in zip(numbers, at_heights, strict=True)
    )


def material_of(technology: Technology, name: str | None) -> str:
    """The material that is named, else the only one that is known. SettingsError where there are several to name."""
    if name is not None:
        return name
    if len(technology.materials) > 1:
        raise SettingsError("technology-needs-material", name=technology.name, known=", ".join(technology.materials))
    return technology.materials[0]


def passes_of(
    technology: Technology, material: str | None, wire_um: float, height_mm: float | None
) -> tuple[PassTechnology, ...]:
    """What each pass does in a material at a height; None for the only one that the technology knows.

    SettingsError where it knows several, and as `passes_at` raises it.
    """
    material = material_of(technology, material)
    heights = sorted({cut.height_mm for cut in technology.cuts if cut.material.casefold() == material.casefold()})
    if height_mm is None and len(heights) > 1:
        raise SettingsError("technology-needs-height", name=technology.name, known=", ".join(f"{h:g}" for h in heights))
    if height_mm is None:
        height_mm = heights[0] if heights else 1.0
    return passes_at(technology, Choice(material, wire_um, height_mm))


def pass_of(known: Sequence[PassTechnology], number: int) -> PassTechnology:
    """What the pass of a number does, from 1; one that is not known does what the nearest before it does."""
    return next((each for each in reversed(known) if each.number <= number), known[0])


class _Law(NamedTuple):
    """How a figure of a row is read, and how sure it is.

    Attributes
    ----------
    value, within
        Of a row: the figure, None where it says none; and half its interval.
    is_ratio
        Whether it is never 0 or less: then its interval is a ratio, as wide to both sides by its logarithm.
    between
        As a share of the figure, how far it may be off halfway between two heights in the ratio of 1 to 3.
    beyond
        The same, at half the least height that is known, or twice the greatest.
    lowest
        What it cannot fall below.
    """

    value: Callable[[Cut], float | None]
    within: Callable[[Cut, Grade, float], float]
    is_ratio: bool
    between: float
    beyond: float
    lowest: float = 0.0


def _rate(cut: Cut) -> float | None:
    """Area rate, mm²/min: beyond the heights that are known it stays, and not the feed."""
    if cut.area_rate_mm2_min is not None or cut.feed_mm_min is None:
        return cut.area_rate_mm2_min
    return cut.feed_mm_min * cut.height_mm


def _or(given: float | None, usual: float) -> float:
    return usual if given is None else given


_GAP = _Law(
    value=lambda cut: cut.gap_um,
    within=lambda cut, grade, _: _or(cut.gap_within_um, GAP_WITHIN_UM[grade]),
    is_ratio=False,
    between=0.0,
    beyond=_BEYOND_GAP,
    lowest=-math.inf,
)
_RATE = _Law(
    value=_rate,
    within=lambda cut, grade, rate: rate * _or(cut.rate_within, RATE_WITHIN[grade]),
    is_ratio=True,
    between=_BETWEEN,
    beyond=_BEYOND_RATE,
)
_LAG = _Law(
    value=lambda cut: cut.lag_um,
    within=lambda cut, grade, lag_um: _or(cut.lag_within_um, lag_um * LAG_WITHIN[grade]),
    is_ratio=False,
    between=_BETWEEN,
    beyond=_BEYOND_LAG,
)
_OFFSET = _Law(
    value=lambda cut: cut.offset_um,
    within=lambda _, grade, __: GAP_WITHIN_UM[grade],
    is_ratio=False,
    between=0.0,
    beyond=_BEYOND_GAP,
)
_ROUGHNESS = _Law(
    value=lambda cut: cut.roughness_um,
    within=lambda _, grade, ra_um: RATE_WITHIN[grade] * ra_um,
    is_ratio=True,
    between=_BETWEEN,
    beyond=_BEYOND_RATE,
)


def _pass_at(number: int, cuts: Sequence[Cut], height_mm: float, technology: Technology) -> PassTechnology:
    """One pass at a height, by its rows in order of height."""
    gap, rate, *others = (_figure(law, cuts, height_mm, technology) for law in (_GAP, _RATE, _LAG, _OFFSET, _ROUGHNESS))
    assert gap is not None  # noqa: S101 - each row has a gap
    feed = None
    if rate is not None:
        value, least, most = (each / height_mm for each in rate[:3])
        feed = rate._replace(value=value, least=least, most=most)
    return PassTechnology(number, gap, feed, *others)


def _figure(law: _Law, cuts: Sequence[Cut], height_mm: float, technology: Technology) -> Figure | None:
    """A figure at a height, of rows in order of height; None where none of them has it.

    It is interpolated in the logarithms of height and figure, straight from row to row: so it rises or falls between
    two rows as they do. A figure of which a row is 0 or less is interpolated as it is.
    """
    known = [(cut, value) for cut in cuts if (value := law.value(cut)) is not None]
    if not known:
        return None
    heights = np.log(np.array([cut.height_mm for cut, _ in known]))
    values = np.array([value for _, value in known])
    at = math.log(height_mm)
    is_log = bool((values > 0.0).all())
    value = float(np.interp(at, heights, np.log(values) if is_log else values))
    value = math.exp(value) if is_log else value
    near = min(max(at, float(heights[0])), float(heights[-1]))
    value = next((own for row, own in zip(heights.tolist(), values.tolist(), strict=True) if row == near), value)
    grades = [cut.grade or technology.grade for cut, _ in known]
    withins = [law.within(cut, grade, value) for (cut, _), grade in zip(known, grades, strict=True)]
    within = float(np.interp(at, heights, withins))
    above = min(int(np.searchsorted(heights, at)), len(known) - 1)
    below = max(above - 1, 0) if at < heights[above] else above
    within = math.hypot(within, abs(value) * _unknown(law, at, heights, above))
    rows = sorted({below, above}, key=lambda row: abs(float(heights[row]) - at))
    worst = worst_grade(grades[row] for row in rows)
    sources = dict.fromkeys(known[row][0].source or technology.source for row in rows)
    ratio = 1.0 + within / value if law.is_ratio else 1.0
    least, most = (value / ratio, value * ratio) if law.is_ratio else (value - within, value + within)
    return Figure(value, max(least, law.lowest), most, worst, "; ".join(sources))


def _unknown(law: _Law, at: float, heights: np.ndarray[Any, np.dtype[np.float64]], above: int) -> float:
    """By which share a figure may be off for want of a row at its height; logarithms of heights."""
    outside = max(float(heights[0]) - at, at - float(heights[-1]), 0.0)
    if outside > 0.0:
        return law.beyond * outside / math.log(2.0)
    if above == 0:
        return 0.0
    step = float(heights[above] - heights[above - 1])
    share = (at - float(heights[above - 1])) / step
    return law.between * 4.0 * share * (1.0 - share) * step / math.log(3.0)
