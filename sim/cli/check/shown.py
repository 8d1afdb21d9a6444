"""What a check would look at, and with which settings: ``--show-files`` and ``--show-settings``.

Both print plain text for people and shells; no program is read.
"""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePath
from typing import Final

from parser.findings.catalogue import Language, in_language
from parser.findings.errors import FileUnreadableError, system_message
from parser.text.encoding import printable
from parser.text.places import cells
from parser.units import mm
from sim.check.settings import CheckSettings
from sim.check.settings.read import KEYS, SettingsFile
from sim.cli.check.jobs import CheckOptions, Jobs
from sim.show.terminal.printer import say
from sim.show.texts import Words

_MOST_KINDS: Final = 6
"""Of files that are passed over, that one line names."""
_FIELDS: Final = {
    "machine": "machine",
    "technology": "technology",
    "material": "material",
    "thickness_mm": "thickness_mm",
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
"""Keys of settings, and the fields of `CheckSettings` that have their values."""
_OF_FOLDER: Final = ("exclude", "include", "baseline", "machines", "dialects", "help_uri")
"""Keys of settings that say something of the folder, beside what a file is checked with."""
_WIRE: Final = ("wire.diameter_mm", "wire.spark_gap_mm")
_KEYS: Final = tuple(each for key in KEYS if key != "root" for each in (_WIRE if key == "wire" else (key,)))
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


def show_files(found: Jobs, language: Language) -> int:
    """Print the name of each file that would be checked; on stderr, what is passed over or missing; the exit code."""
    for job in found.jobs:
        say(printable(job.name))
    return _end(found, language)


def show_settings(found: Jobs, options: CheckOptions, language: Language) -> int:
    """Print with which settings the files would be checked, and what gave each; the exit code.

    Files with the same settings stand together.
    """
    alike: dict[tuple[str, ...], list[str]] = {}
    for job, near in zip(found.jobs, found.near, strict=True):
        lines = tuple(_lines(job.settings, near, options, Words(language)))
        alike.setdefault(lines, []).append(printable(job.name))
    for lines, (first, *others) in alike.items():
        key = "findings.settings-of-some" if others else "findings.settings-of"
        say(Words(language)(key, file=first, n=len(others)))
        for line in lines:
            say(f"  {line}")
    return _end(found, language)


def _end(found: Jobs, language: Language) -> int:
    passed = passed_over_text(found.passed_over, language)
    if passed:
        say(passed, err=True)
    missing = list(_missing(found))
    for error in missing:
        say(Words(language)("commands.error", message=in_language(error.in_both(), language)), err=True)
    return 2 if missing else 0


def _missing(found: Jobs) -> Iterator[FileUnreadableError]:
    """What is wrong with files that are named and are not there."""
    for job in found.jobs:
        try:
            if isinstance(job.source, Path):
                job.source.stat()
        except (OSError, ValueError) as error:  # ValueError: a NUL in the name
            yield FileUnreadableError("cannot-be-read", file=job.source, why=system_message(error))


def _lines(settings: CheckSettings, near: SettingsFile, options: CheckOptions, words: Words) -> Iterator[str]:
    """A line for each key: its value as TOML has it, and what gave it; of ``fail_on`` what fails besides."""
    rows = [
        (_of_folder(near, key), _source_of_folder(settings, near, options, key, words))
        if key in _OF_FOLDER
        else (_value(settings, key), _source(settings, _FIELDS[key], words))
        for key in _KEYS
    ]
    texts = [f"{key} = {value}" for key, (value, _) in zip(_KEYS, rows, strict=True)]
    width = max(cells(printable(text)) for text in texts)
    for key, text, (_, source) in zip(_KEYS, texts, rows, strict=True):
        fails = words(f"findings.fails-{settings.fail_on}") if key == "fail_on" else ""
        padded = printable(text) + " " * (width - cells(printable(text)))
        yield f"{padded}  # {words('findings.stop').join(filter(None, (printable(source), fails)))}"


def _source(settings: CheckSettings, field: str, words: Words) -> str:
    if field in settings.by_options:
        return words("findings.from-options")
    return _file_or_usual(settings, words, is_said=getattr(settings, field) != getattr(_USUAL, field))


def _source_of_folder(
    settings: CheckSettings, near: SettingsFile, options: CheckOptions, key: str, words: Words
) -> str:
    if getattr(options, key, None):
        return words("findings.from-options")
    return _file_or_usual(settings, words, is_said=bool(getattr(near, key)))


def _file_or_usual(settings: CheckSettings, words: Words, *, is_said: bool) -> str:
    return settings.file if settings.file and is_said else words("findings.as-usual")


def _of_folder(near: SettingsFile, key: str) -> str:
    """Patterns as they were written, names of dialects, and paths as seen from the working folder if below that."""
    value = getattr(near, key)
    if isinstance(value, Path):
        working = Path.cwd().resolve()
        return _toml((value.relative_to(working) if value.is_relative_to(working) else value).as_posix())
    if value is None or isinstance(value, str):
        return _toml(value)
    return _toml(tuple(getattr(each, "text", each) for each in value))


def _value(settings: CheckSettings, key: str) -> str:
    value = getattr(settings, _FIELDS[key])
    if key == "dialect":
        return _toml(str(value))
    if key in ("machine", "technology"):
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
