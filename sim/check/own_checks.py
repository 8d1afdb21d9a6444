"""Checks of a shop's own: functions that distributions offer under the entry point ``drycut.checks`` (docs/python.md).

They see a program as it was read, and give findings with codes and texts of their own. They are found once, when the
first program is checked.
"""

import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any, Final, Literal, NamedTuple

import numpy as np

from parser.findings.catalogue import LANGUAGES, CataloguePage, add_pages, add_terms, filled
from parser.findings.codes import CODES, FindingCode, Severity, add_codes
from parser.findings.findings import Finding, Value, file_order
from parser.program import Program
from parser.text.source import Span
from sim.check.path_checks import Checked
from sim.check.result import CheckState

GROUP: Final = "drycut.checks"
"""Name of the group of entry points."""
_CODE: Final = re.compile(r"[A-Z]{2,8}[1-9]\d\d", re.ASCII)
_OURS: Final = frozenset(code[:-3] for code in CODES)
"""Beginnings of the codes of drycut."""
_NAME: Final = re.compile(r"[a-z]+(?:-[a-z]+)*", re.ASCII)
_RAISED: Final = "reason-raised"
_MOST: Final = 10_000
"""Findings of one check of one program."""


class OwnTexts(NamedTuple):
    """Texts of a code in one language; all but the title may be left out.

    Attributes
    ----------
    title
        What findings of the code are called.
    found, expected, machine, hint
        One line each: what was found, what was expected, what the machine would do, how to mend it. Places such as
        ``{far:um}`` are filled from the values of a finding: ``um`` and ``mm`` write a length that is in µm, ``block``
        a block as the listing calls it.
    why, mend
        Markdown of its page: why it matters, how it is mended.
    """

    title: str
    found: str = ""
    expected: str = ""
    machine: str = ""
    hint: str = ""
    why: str = ""
    mend: str = ""


class OwnCode(NamedTuple):
    """A code of a check of one's own.

    Attributes
    ----------
    severity
        How its findings count.
    en
        Its texts in English.
    zh
        Its texts in Chinese; None where the English ones stand for them.
    """

    severity: Literal["error", "warning", "note"]
    en: OwnTexts
    zh: OwnTexts | None = None


class OwnFinding(NamedTuple):
    """What a check of one's own found.

    Attributes
    ----------
    code
        One of the codes of the check.
    block
        Number of the block, as `Program.toolpath.source.block` has it, from 1; 0 where no block is meant.
    line
        Line from 1, where no block is meant; 0 of the whole program.
    values
        What fills the texts of the code; lengths in µm.
    """

    code: str
    block: int = 0
    line: int = 0
    values: Mapping[str, Value] = {}


class OwnCheck(NamedTuple):
    """A check of one's own, which an entry point names.

    Attributes
    ----------
    run
        From a program to what is wrong with it; it changes nothing.
    codes
        Its codes: two to eight capital letters, not those of drycut, and three digits, such as ``SHOP101``.
    title
        What people call it, in English.
    title_zh
        The same in Chinese; that in English where it is empty.
    """

    run: Callable[[Program], Iterable[OwnFinding]]
    codes: Mapping[str, OwnCode]
    title: str
    title_zh: str = ""


class _Offered(NamedTuple):
    """A check by the name of its entry point, or why it cannot be used."""

    name: str
    check: OwnCheck | None
    wrong: str = ""


def load_own_checks() -> None:
    """Find the checks of one's own, so that their codes are known."""
    _offered()


def has_own_checks() -> bool:
    """Whether there are any here."""
    return bool(_offered())


def with_own_checks(program: Program, checked: Checked) -> Checked:
    """What the checks of drycut found, and what those of one's own find besides.

    A check that raises, or gives what is no finding, is incomplete, and its reason names the error.
    """
    offered = _offered()
    if not offered:
        return checked
    findings, states = list(checked.findings), list(checked.coverage.checks)
    for each in offered:
        found, why = _found(each, program)
        findings += found
        name = _check_name(each.name)
        states.append(CheckState(name, "incomplete", _RAISED, (why,)) if why else CheckState(name))
    named = program.toolpath.source.names.named(tuple(sorted(findings, key=file_order)))
    return checked._replace(findings=named, coverage=checked.coverage._replace(checks=tuple(states)))


def _found(offered: _Offered, program: Program) -> tuple[list[Finding], str]:
    """Findings of a check, or why there are none."""
    if offered.check is None:
        return [], offered.wrong
    try:
        return [_finding(each, offered.check, program) for each in _bounded(offered.check.run(program))], ""
    except (Exception, SystemExit) as error:
        return [], _error_text(error)


def _bounded(found: Iterable[OwnFinding]) -> Iterator[OwnFinding]:
    for count, each in enumerate(found):
        if count == _MOST:
            raise ValueError(f"more than {_MOST} findings")
        yield each


def _finding(found: OwnFinding, check: OwnCheck, program: Program) -> Finding:
    """A finding as drycut has it. ValueError, TypeError or KeyError for one that cannot be shown."""
    own = check.codes.get(found.code) if isinstance(found, OwnFinding) else None
    if own is None:
        raise ValueError(f"{found!r:.80} is no finding of its codes")
    values = {name: _value(value) for name, value in found.values.items()}
    for texts in filter(None, (own.en, own.zh)):
        for template in (texts.found, texts.expected, texts.machine, texts.hint):
            filled(template, values)
    span = _span(found, program)
    if span is None:
        return Finding(found.code, values)
    lines = program.lines
    return Finding(found.code, values, span, lines.line(span[0]), lines.column(span[0]), found.block)


def _span(found: OwnFinding, program: Program) -> Span | None:
    """The characters of its block, or of its line; None of a finding of the whole program."""
    if found.block:
        source = program.toolpath.source
        row = int(np.searchsorted(source.block, found.block))
        if row == len(source.block) or source.block[row] != found.block:
            raise ValueError(f"there is no block {found.block}")
        first, past = source.span[row].tolist()
        return first, past
    return program.lines.bounds(found.line) if found.line else None


def _value(value: object) -> Value:
    """A value as findings have them: numbers of numpy too."""
    if isinstance(value, str | int | float):
        return value
    return float(value)  # type: ignore[arg-type]  # raises TypeError where it is none


@cache
def _offered() -> tuple[_Offered, ...]:
    """All checks that are offered, by their names; their codes and texts are known from then on.

    The working folder, which `python -m` puts into the path, offers none: what stands there may be anybody's.
    """
    here = _working_folder()
    folders = [folder for folder in sys.path if folder and Path(folder).resolve() != here and _is_offering(folder)]
    if not folders:
        return ()
    from importlib.metadata import distributions  # noqa: PLC0415 - it takes 35 ms, and most have no such checks

    entries = [entry for each in distributions(path=folders) for entry in each.entry_points.select(group=GROUP)]
    by_name = {entry.name: entry for entry in sorted(entries, reverse=True)}
    return tuple(_read(name, entry.value) for name, entry in sorted(by_name.items()))


def _working_folder() -> Path | None:
    """The working folder without links; None where it is gone."""
    try:
        return Path.cwd().resolve()
    except OSError:
        return None


def _is_offering(folder: str) -> bool:
    """Whether a distribution in a folder of the path offers checks."""
    mark = f"[{GROUP}]".encode()
    try:
        infos = [each for each in Path(folder).iterdir() if each.suffix in (".dist-info", ".egg-info")]
    except OSError:
        return False
    return any(mark in _content(each / "entry_points.txt") for each in infos)


def _content(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except OSError:
        return b""


def _read(name: str, value: str) -> _Offered:
    """The check that an entry point names, with its codes and texts registered."""
    try:
        module, _, attribute = value.partition(":")
        check: Any = import_module(module.strip())
        for part in filter(None, attribute.strip().split(".")):
            check = getattr(check, part)
        wrong = _wrong(name, check)
        if not wrong:
            _register(name, check)
            return _Offered(name, check)
    except (Exception, SystemExit) as error:
        wrong = _error_text(error)
    add_terms({_check_name(name): dict.fromkeys(LANGUAGES, name)})
    return _Offered(name, None, f"{value}: {wrong}")


def _wrong(name: str, check: object) -> str:
    """Why a check cannot be used; empty where it can."""
    if not isinstance(check, OwnCheck):
        return "is no drycut.OwnCheck"
    if not _NAME.fullmatch(name):
        return "its name is not of small letters and -"
    for code, of in check.codes.items():
        if not _CODE.fullmatch(code) or code in CODES or code[:-3] in _OURS:
            return f"{code!r:.40} is no code of one's own, or another check has it"
        if of.severity not in tuple(Severity):
            return f"{code}: {of.severity!r:.40} is no severity"
    return ""


def _register(name: str, check: OwnCheck) -> None:
    add_codes({code: FindingCode(Severity(of.severity), _check_name(name)) for code, of in check.codes.items()})
    add_pages({code: {"en": _page(of.en), "zh": _page(of.zh or of.en)} for code, of in check.codes.items()})
    add_terms({_check_name(name): {"en": check.title, "zh": check.title_zh or check.title}})


def _page(texts: OwnTexts) -> CataloguePage:
    return CataloguePage(**{**texts._asdict(), "found": texts.found or texts.title, "why": texts.why or texts.title})


def _check_name(name: str) -> str:
    """Name of a check as results have it; of an entry point that is no name, that of its letters."""
    return "check-" + ("-".join(re.findall(r"[a-z]+", name.lower())) or "own")


def _error_text(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"[:200]
