"""Words of the page in English and Chinese, both of them in it, from ``report.toml``."""

import tomllib
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

from parser.findings.catalogue import LANGUAGES, Language, term
from sim.setup.quiz import Said
from sim.units import clock

_TEXTS = Path(__file__).with_name("report.toml")
_UNITS_OF_TIME = {" h": " 小时", " min": " 分", " s": " 秒"}


def said(key: str, **values: object) -> Said:
    """Text of a key, filled with values, of which one that is itself `Said` gives each language its own.

    KeyError where there is no such text.
    """
    return Said(*(_filled(key, language, values) for language in LANGUAGES))


def same(text: object) -> Said:
    """A text that is the same in both: a name, a number."""
    return Said(str(text), str(text))


def listed(texts: Iterable[Said]) -> Said:
    """Texts one after the other."""
    parts, comma = list(texts), said("comma")
    return Said(comma.en.join(part.en for part in parts), comma.zh.join(part.zh for part in parts))


def catalogued(key: str) -> Said:
    """A term of the catalogue, such as the name of a check; nothing for an empty key."""
    return Said(*(term(key, language) for language in LANGUAGES)) if key else same("")


def numbered(number: Mapping[str, int]) -> Said:
    """How many there are of each, such as ``2 errors, 1 note``; without those of which there is none."""
    return listed(said(f"one-{key}" if n == 1 else key, n=f"{n:,}") for key, n in number.items() if n)


def lasting(seconds: float) -> Said:
    """A duration, such as ``2 h 27 min``."""
    text = clock(seconds)
    chinese = text
    for unit, word in _UNITS_OF_TIME.items():
        chinese = chinese.replace(unit, word)
    return Said(text, chinese)


@cache
def texts() -> Mapping[str, Mapping[Language, str]]:
    """All texts: key to language to template."""
    return tomllib.loads(_TEXTS.read_text(encoding="utf-8"))


def _filled(key: str, language: Language, values: Mapping[str, object]) -> str:
    return texts()[key][language].format(**{name: _in(value, language) for name, value in values.items()})


def _in(value: object, language: Language) -> object:
    return getattr(value, language) if isinstance(value, Said) else value
