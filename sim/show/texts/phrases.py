"""Texts put together in both languages: names and numbers, lists, counts, durations."""

from collections.abc import Iterable, Mapping
from itertools import groupby
from typing import TYPE_CHECKING

from parser.dialect.reader import Assumption
from parser.findings.catalogue import LANGUAGES, Bilingual, term
from parser.shape.passes import Pass
from sim.base.units import clock
from sim.measure.factor import UNKNOWN, Interval
from sim.show.texts.texts import bilingual

if TYPE_CHECKING:
    from sim.setup.machine.machine import Machine
    from sim.setup.technology import Technology

_UNITS_OF_TIME = {" h": "phrases.hours", " min": "phrases.minutes", " s": "phrases.seconds"}


def same(text: object) -> Bilingual:
    """A text that is the same in both: a name, a number."""
    return Bilingual(str(text), str(text))


def listed(texts: Iterable[Bilingual]) -> Bilingual:
    """Texts one after the other."""
    parts, comma = list(texts), bilingual("phrases.comma")
    return Bilingual(comma.en.join(part.en for part in parts), comma.zh.join(part.zh for part in parts))


def catalogued(key: str) -> Bilingual:
    """A term of the catalogue, such as the name of a check; nothing for an empty key."""
    return Bilingual(*(term(key, language) for language in LANGUAGES)) if key else same("")


def as_read(assumptions: Iterable[Assumption]) -> Bilingual:
    """What the text of a program leaves open, and was taken; those with one reason together.

    ``dialect fast-wire (it ends with M02), unit 1 = 0.001 mm, I J from the start (the dialect begins so)``.
    """
    return listed(
        bilingual("phrases.for-a-reason", taken=listed(map(_taken_text, group)), why=catalogued(why))
        for why, group in groupby(assumptions, key=lambda assumption: assumption.why)
    )


def _taken_text(assumption: Assumption) -> Bilingual:
    """What was taken, by its term of the catalogue where it is a word and no figure."""
    words = catalogued(f"{assumption.what.removeprefix('assumed-')}-{assumption.taken}")
    is_term = not words.en.startswith("`")
    return bilingual("phrases.taken", what=catalogued(assumption.what), taken=words if is_term else assumption.taken)


def numbered(number: Mapping[str, int]) -> Bilingual:
    """How many there are of each, such as ``2 errors, 1 note``; without those of which there is none."""
    return listed(
        bilingual(f"phrases.{'one' if n == 1 else 'some'}-{key}", n=f"{n:,}") for key, n in number.items() if n
    )


def lasting(seconds: float) -> Bilingual:
    """A duration, such as ``2 h 27 min``."""
    english = chinese = clock(seconds)
    for unit, key in _UNITS_OF_TIME.items():
        chinese = chinese.replace(unit, bilingual(key).zh)
    return Bilingual(english, chinese)


def lasting_within(ran_s: float, time_s: Interval | None, technology: "Technology | None") -> Bilingual:
    """How long a run takes, with its interval; without one where a program for the card set its own speeds."""
    if time_s is None:
        return lasting(ran_s)
    if technology is None:
        return with_interval(time_s, 0)
    least, middle, most = map(lasting, time_s[:3])
    level, name = round(100.0 * time_s.level), technology_name(technology)
    return bilingual("time.by-technology", middle=middle, least=least, most=most, level=level, name=name)


def by_no_cut() -> Bilingual:
    """How sure a time is of which no cut of the machine is known."""
    return bilingual("time.unknown", share=round(100.0 * UNKNOWN))


def with_interval(time_s: Interval, from_cuts: int) -> Bilingual:
    """A time with its interval, such as ``3 h 12 min (2 h 40 min … 4 h 5 min, 90 %, from 14 cuts of this shop)``."""
    least, middle, most = map(lasting, time_s[:3])
    if not from_cuts:
        return bilingual("time.without-cuts", middle=middle, unknown=by_no_cut())
    cuts = bilingual("time.one-cut" if from_cuts == 1 else "time.some-cuts", number=from_cuts)
    level = round(100.0 * time_s.level)
    return bilingual("time.with-interval", middle=middle, least=least, most=most, level=level, cuts=cuts)


def counted_pass(pass_: Pass, among: int) -> Bilingual:
    """Which pass among so many over its edge, and which way it runs beside the first, such as ``2 of 3, back``."""
    way = bilingual("phrases.back" if pass_.is_back else "phrases.forward")
    key = "phrases.counted-tab" if pass_.is_tab else "phrases.counted-pass"
    return bilingual(key, number=pass_.number, among=among, way=way)


def technology_name(technology: "Technology") -> Bilingual:
    """Name of a technology, in Chinese where its file has one."""
    return Bilingual(technology.name, technology.name_zh or technology.name)


def machine_name(machine: "Machine") -> Bilingual:
    """Name of a machine, in Chinese where its file has one."""
    return Bilingual(machine.name, machine.name_zh or machine.name)


def named_pass(pass_: Pass, among: int) -> Bilingual:
    """The same as a name of its own, such as ``pass 2 of 3, back``."""
    return bilingual("phrases.pass", counted=counted_pass(pass_, among))
