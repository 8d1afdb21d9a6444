"""What a check would look at, and with which settings: ``--show-files`` and ``--show-settings``.

Both print plain text for people and shells; no program is read.
"""

import json
from collections.abc import Iterator, Sequence
from pathlib import PurePath
from typing import Final

from parser.findings.catalogue import Language
from parser.text.encoding import printable
from parser.text.places import cells
from parser.units import mm
from sim.check.settings import CheckSettings
from sim.cli.check.jobs import Jobs
from sim.show.terminal.printer import say
from sim.show.texts import Words

_MOST_KINDS: Final = 6
"""Of files that are passed over, that one line names."""
_FIELDS: Final = {
    "machine": "machine",
    "start_mm": "start_mm",
    "open": "may_stay_open",
    "select": "select",
    "ignore": "ignore",
    "per_file_ignores": "ignore_here",
    "fail_on": "fail_on",
    "dialect": "dialect",
    "unit": "unit",
    "registers_mm": "registers",
    "end_marks": "marks",
    "pause_marks": "marks",
    "wire.diameter_mm": "wire_diameter_um",
    "wire.spark_gap_mm": "spark_gap_um",
}
"""Keys of settings in the order of docs/check.md, and the fields of `CheckSettings` that have their values."""
_USUAL: Final = CheckSettings()


def passed_over_text(names: Sequence[str], language: Language) -> str:
    """``3 files passed over: .txt, .TAP, O0013``: how many, and of which kinds; empty where there are none."""
    if not names:
        return ""
    kinds = list(dict.fromkeys(PurePath(name).suffix or PurePath(name).name for name in names))
    words = Words(language)
    more = [words("findings.more", n=len(kinds) - _MOST_KINDS)] if len(kinds) > _MOST_KINDS else []
    listed = words("findings.comma").join([*map(printable, kinds[:_MOST_KINDS]), *more])
    return words("findings.passed-over" if len(names) > 1 else "findings.one-passed-over", n=len(names), kinds=listed)


def show_files(found: Jobs, language: Language) -> None:
    """Print the name of each file that would be checked; on stderr, what is passed over."""
    for job in found.jobs:
        say(printable(job.name))
    _end(found, language)


def show_settings(found: Jobs, language: Language) -> None:
    """Print with which settings the files would be checked, and what gave each.

    Files with the same settings stand together.
    """
    alike: dict[tuple[str, ...], list[str]] = {}
    for job in found.jobs:
        alike.setdefault(tuple(_lines(job.settings, Words(language))), []).append(printable(job.name))
    for lines, (first, *others) in alike.items():
        key = "findings.settings-of-some" if others else "findings.settings-of"
        say(Words(language)(key, file=first, n=len(others)))
        for line in lines:
            say(f"  {line}")
    _end(found, language)


def _end(found: Jobs, language: Language) -> None:
    passed = passed_over_text(found.passed_over, language)
    if passed:
        say(passed, err=True)


def _lines(settings: CheckSettings, words: Words) -> Iterator[str]:
    """A line for each key: its value as TOML has it, and what gave it; of ``fail_on`` what fails besides."""
    rows = [(f"{key} = {_value(settings, key)}", _source(settings, field, words)) for key, field in _FIELDS.items()]
    width = max(cells(printable(text)) for text, _ in rows)
    for key, (text, source) in zip(_FIELDS, rows, strict=True):
        fails = words(f"findings.fails-{settings.fail_on}") if key == "fail_on" else ""
        padded = printable(text) + " " * (width - cells(printable(text)))
        yield f"{padded}  # {words('findings.stop').join(filter(None, (printable(source), fails)))}"


def _source(settings: CheckSettings, field: str, words: Words) -> str:
    if field in settings.by_options:
        return words("findings.from-options")
    if settings.file and getattr(settings, field) != getattr(_USUAL, field):
        return settings.file
    return words("findings.as-usual")


def _value(settings: CheckSettings, key: str) -> str:
    value = getattr(settings, _FIELDS[key])
    if key == "dialect":
        return _toml(str(value))
    if key == "machine":
        value = value and value.name
    elif key in ("end_marks", "pause_marks"):
        value = getattr(value, key.removesuffix("_marks"))
    elif key == "registers_mm":
        return "{ " + ", ".join(f"{name} = {mm(um):g}" for name, um in value) + " }" if value else "{}"
    elif key.endswith("diameter_mm") or key.endswith("gap_mm"):
        value = None if value is None else mm(value)
    return _toml(value)


def _toml(value: object) -> str:
    """A value as TOML has it; a dash where there is none, which TOML cannot say."""
    if value is None or value == "":
        return "–"
    if isinstance(value, tuple):
        return f"[{', '.join(map(_toml, value))}]"
    return json.dumps(value, ensure_ascii=False)
