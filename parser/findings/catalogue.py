"""Texts of the findings in English and Chinese: one page a code, in ``parser/findings/pages``.

Terms, remarks and what joins texts stand there too, each kind in a file.

Remarks: what is to be said of a result beside its figures, as data; their words stand in ``pages/remarks.toml``.
"""

import string
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, NamedTuple

from parser.documents import SaidEntry
from parser.findings.codes import CODES
from parser.findings.findings import NO_NAMES, Finding, Value
from parser.units import UM_PER_MM, mm, mm_text

Language = Literal["en", "zh"]
LANGUAGES: tuple[Language, ...] = ("en", "zh")

TO = "‥"
"""Between the ends of a range among the values of a finding."""

_PAGES = Path(__file__).with_name("pages")


class Bilingual(NamedTuple):
    """A text in both languages."""

    en: str
    zh: str

    def entry(self) -> SaidEntry:
        """It as documents have it."""
        return {"en": self.en, "zh": self.zh}


class CataloguePage(NamedTuple):
    """Page of one code in one language.

    `found`, `expected`, `machine` and `hint` are templates of one line, filled from a finding's values; `why` and
    `mend` are Markdown.
    """

    title: str
    found: str
    expected: str
    machine: str
    hint: str
    why: str
    mend: str


class Example(NamedTuple):
    """A program with the fault, the same one mended, and what ``drycut check`` needs to see the fault.

    `files` are those that the options name: their names, and their texts.
    """

    program: str
    mended: str
    options: tuple[str, ...]
    files: Mapping[str, str]


class Texts(NamedTuple):
    """Texts of one finding: what it is called, what was found and expected, what the machine does, how to mend it."""

    title: str
    found: str
    expected: str
    machine: str
    hint: str
    message: str


def page(code: str, language: Language = "en") -> CataloguePage:
    """Page of a code. KeyError where there is no such code."""
    return CataloguePage(**_file(code)[language])


def example(code: str) -> Example | None:
    """Example of a code, None where a program alone cannot show it. KeyError where there is no such code."""
    found = _file(code).get("example")
    if found is None:
        return None
    return Example(found["program"], found["mended"], tuple(found.get("options", ())), found.get("files", {}))


def texts(finding: Finding, language: Language = "en") -> Texts:
    """Texts of a finding in one language."""
    of = page(finding.code, language)
    templates = {"found": of.found, "expected": of.expected, "machine": of.machine, "hint": of.hint}
    if finding.is_uncertain:
        templates["hint"] = term("not-certain", language)
    parts = {name: filled(template, finding.values, language, finding.names) for name, template in templates.items()}
    return Texts(of.title, **parts, message=_read("joints")[language]["message"].format(**parts))


def filled(
    template: str, values: Mapping[str, object], language: Language = "en", names: Mapping[int, str] = NO_NAMES
) -> str:
    """A template of a page, its places filled: they know ``{miss:um}``, ``{x:mm}``, ``{what:term}`` and the like.

    ``{first:block}`` is the number of a block; `names` has those that people call by another name. Of a value that is
    a text in both languages the one of the language is taken.
    """
    return _Filler(language, names).vformat(
        template, (), {name: in_language(value, language) for name, value in values.items()}
    )


def in_language(value: object, language: Language) -> object:
    """A value in a language: the text, where it is one in both (`Bilingual`, a message); else the value as it is."""
    # By attribute: a check of its type through a protocol takes longer than all else of a text.
    return getattr(value, language, value) if isinstance(value, str | tuple) else value


def remark_template(name: str, language: Language) -> str:
    """Template of a remark. KeyError where there is no such remark."""
    return str(_read("remarks")[language][name])


def term(key: str, language: Language = "en") -> str:
    """Text of a term, such as the name of a check; a key that is no term stands for itself, in backquotes."""
    if key in _own_terms:
        return _own_terms[key][language]
    return str(_read("terms")[language].get(key, f"`{key}`"))


@cache
def message_templates() -> Mapping[str, Bilingual]:
    """Templates of all messages by their codes."""
    return {code: Bilingual(**text) for code, text in _read("messages").items()}


def length(um: float) -> str:
    """A length for people: µm with two digits, from 1 mm up mm with three."""
    return f"{um:.2f} µm" if abs(um) < UM_PER_MM else f"{mm(um):.3f} mm"


def instant(t_s: float) -> str:
    """A time into a run for people: ``3:12:04.25``, hours, minutes and seconds."""
    minutes, hundredths = divmod(round(t_s * 100.0), 6000)
    return f"{minutes // 60}:{minutes % 60:02}:{hundredths / 100.0:05.2f}"


class _Filler(string.Formatter):
    """Fills templates; besides Python's own formats it knows ``um``, ``mm``, ``instant``, ``term``, and those below.

    ``block`` is the number of a block, which is called as the listing calls it.
    ``aside`` is a text in parentheses, ``or`` another choice, both nothing where there is none; ``pass`` the number of
    a pass, ``more`` how many others there are, both nothing for 0; ``chance`` a range that hangs on chance, nothing
    where there is none. ``known`` is a value, or the word for none; ``span`` is a range, two ends with `TO` between of
    which one may be missing, or a value that is no range.
    """

    def __init__(self, language: Language, names: Mapping[int, str]) -> None:
        self._language, self._names = language, names

    def format_field(self, value: Any, format_spec: str) -> str:
        own: dict[str, Callable[[Any], str]] = {
            "um": lambda um: length(float(um)),
            "mm": mm_text,
            "instant": lambda t_s: instant(float(t_s)),
            "block": lambda number: self._names.get(number, str(number)),
            "term": lambda key: term(str(key), self._language),
            "known": self._known,
            "span": lambda ends: self._span(str(ends)),
            "aside": lambda text: self._joined("aside", text) if text else "",
            "or": lambda text: self._joined("or", text) if text else "",
            "pass": lambda number: self._joined("pass", str(number)) if number else "",
            "chance": lambda ends: self._joined("chance", *str(ends).split(TO)) if ends else "",
            "more": lambda number: self._joined("more", str(number)) if number else "",
        }
        return own[format_spec](value) if format_spec in own else str(super().format_field(value, format_spec))

    def _joined(self, name: str, *texts: str) -> str:
        return str(_read("joints")[self._language][name].format(*texts))

    def _known(self, value: str) -> str:
        return value or term("nothing", self._language)

    def _span(self, value: str) -> str:
        low, dots, high = value.partition(TO)
        if not dots:
            return self._known(value)
        name = "from-to" if low and high else "at-least" if low else "at-most"
        return self._joined(name, *filter(None, (low, high)))


_own_pages: dict[str, Mapping[Language, CataloguePage]] = {}
_own_terms: dict[str, Mapping[Language, str]] = {}


def own_codes() -> tuple[str, ...]:
    """Codes of checks of a shop's own, as far as such checks were found."""
    return tuple(sorted(_own_pages))


def add_pages(pages: Mapping[str, Mapping[Language, CataloguePage]]) -> None:
    """Make the pages of codes of a shop's own known, in both languages."""
    _own_pages.update(pages)


def add_terms(terms: Mapping[str, Mapping[Language, str]]) -> None:
    """Make names of checks of a shop's own known, in both languages."""
    _own_terms.update(terms)


def _file(code: str) -> dict[str, Any]:
    if code in _own_pages:
        return {language: of._asdict() for language, of in _own_pages[code].items()}
    if code not in CODES:
        raise KeyError(code)
    return _read(code)


@cache
def _read(name: str) -> dict[str, Any]:
    import tomllib  # noqa: PLC0415 - a program without findings needs no page

    return tomllib.loads((_PAGES / f"{name}.toml").read_text(encoding="utf-8"))


class Remark(NamedTuple):
    """One thing to be said: its name, and what fills its text.

    Lengths among the values are in µm, those that end on ``_mm`` and ``_deg`` in mm and degrees.
    """

    name: str
    values: Mapping[str, Value] = MappingProxyType({})


def remark_text(remark: Remark, language: Language = "en", names: Mapping[int, str] = NO_NAMES) -> str:
    """Text of a remark in one language. KeyError where the catalogue has no such remark.

    `names` has the blocks, by number, that the listing calls by another name.
    """
    return filled(remark_template(remark.name, language), remark.values, language, names)
