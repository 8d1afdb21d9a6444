"""The jobs of a check: its files, each with the settings that count for it; shown where that is asked for.

What a check would look at, and with which settings: ``--show-files`` and ``--show-settings``.

Both print plain text for people and shells; no program is read.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import click

from parser.dialect.reader import ChosenDialect, merged
from parser.files import read_stdin
from parser.findings.catalogue import Language, in_language
from parser.findings.codes import CODES
from parser.findings.errors import FileUnreadableError, Message, system_message
from parser.text.encoding import printable
from parser.text.places import cells
from parser.units import mm
from sim.check.file_check import Job
from sim.check.files import STORED, FileFilter, find_files
from sim.check.settings import CheckSettings
from sim.check.settings.model import WIRE_LENGTHS
from sim.check.settings.read import (
    KEYS,
    NAMES,
    NO_SETTINGS,
    PathPattern,
    SettingsFile,
    code_list,
    mildest_failing,
    pattern_list,
)
from sim.check.settings.search import SettingsSearch
from sim.cli.options import taken_settings, taken_taper, taper_of
from sim.setup.dialect import chosen_dialect
from sim.setup.part import MATERIAL, THICKNESS
from sim.setup.toml.keys import Key
from sim.show.terminal.printer import say
from sim.show.texts import Words

if TYPE_CHECKING:
    from sim.check.silence import Baseline
    from sim.cli.options import RegisterSet
    from sim.setup.machine.machine import Machine
    from sim.setup.taper import TaperSettings


STDIN = "-"
_OF_WORK: Final[Mapping[str, Key]] = {"material": MATERIAL, "thickness_mm": THICKNESS}
"""Keys of the work that a technology is asked for, by the fields of `CheckSettings` that have their values."""


class CheckOptions(NamedTuple):
    """Options of the command line that take the place of settings; None where one is left out. Lengths in µm.

    `config` takes the place of the settings files that stand near the programs, and so does `no_config`. Where a
    baseline is written, none is read.
    """

    select: str | None
    ignore: str | None
    fail_on: str | None
    machine: str | None
    technology: Path | None
    work: Mapping[str, Any]
    lengths: Mapping[str, float]
    taper: "TaperSettings | None"
    may_stay_open: bool
    dialect: ChosenDialect | None
    unit: str | None
    offset: tuple["RegisterSet", ...]
    exclude: tuple[str, ...]
    include: tuple[str, ...]
    config: Path | None
    no_config: bool
    baseline: Path | None
    write_baseline: Path | None


NO_OPTIONS: Final = CheckOptions(
    *(None, None, None, None, None, {}, {}, None, False, None, None, (), (), (), None),
    no_config=False,
    baseline=None,
    write_baseline=None,
)
"""None is given."""


def check_options_of(values: dict[str, Any]) -> CheckOptions:
    """The options as click hands them over."""
    return CheckOptions(
        work=taken_settings(_OF_WORK.values(), values),
        lengths=taken_settings(WIRE_LENGTHS.values(), values),
        taper=taper_of(taken_taper(values), None),
        **values,
    )


class Jobs(NamedTuple):
    """A job for each file that names lead to, the settings file near each, and the files that are passed over."""

    jobs: list[Job]
    near: list[SettingsFile]
    passed_over: list[str]

    @property
    def help_uri(self) -> str:
        """Address of the pages of findings: of several settings files that of the first which has one."""
        return next((near.help_uri for near in self.near if near.help_uri), "")


def jobs_of(names: Sequence[str], options: CheckOptions) -> Jobs:
    """The jobs of names.

    Raises FileUnreadableError for a name that leads to none, SettingsError for settings that cannot be.
    """
    if options.config and options.no_config:
        raise click.UsageError(Message("config-and-no-config"))
    if options.baseline and options.write_baseline:
        raise click.UsageError(Message("baseline-and-write-baseline"))
    making = _Making(options)
    found = find_files(names, making.file_filter)
    jobs = [making.job(name) for name in found.files]
    near = [making.near(name) for name in found.files]
    return Jobs(jobs, near, [name for name in found.passed_over if not making.is_own(Path(name))])


def filter_of(options: CheckOptions) -> FileFilter:
    """Which files of folders are checked. Raises what `jobs_of` raises of settings."""
    return _Making(options).file_filter


class _Making:
    """Makes jobs; settings files and baselines are read once."""

    def __init__(self, options: CheckOptions) -> None:
        self._asked = options
        self._options = _settings(options)
        self._search = SettingsSearch()
        self._only = (
            self._search.named(options.config) if options.config else NO_SETTINGS if options.no_config else None
        )
        self._exclude = self._patterns(options.exclude, "--exclude")
        self._include = self._patterns(options.include, "--include")
        self._baselines: dict[Path, Baseline] = {}
        self._machines: dict[Path | None, Machine] = {}

    @property
    def file_filter(self) -> FileFilter:
        """Which files of folders are checked."""
        return FileFilter(self._is_excluded, self._is_included)

    def is_own(self, path: Path) -> bool:
        """Whether a file is one of drycut's own: settings, stored results, or a baseline that was read."""
        return path.name in (*NAMES, STORED) or self._search.placed(path) in self._baselines

    def _is_excluded(self, path: Path) -> bool:
        placed = self._search.placed(path)
        patterns = self._near(placed).exclude if self._exclude is None else self._exclude
        return any(pattern.matches(placed) for pattern in patterns)

    def _is_included(self, path: Path) -> bool:
        placed = self._search.placed(path)
        patterns = self._near(placed).include if self._include is None else self._include
        return any(pattern.matches(placed) for pattern in patterns)

    def _patterns(self, given: tuple[str, ...], option: str) -> tuple[PathPattern, ...] | None:
        """Patterns that an option gives; None where it is left out."""
        return pattern_list(list(given), self._search.working, option) if given else None

    def job(self, name: str) -> Job:
        """The job of one file; ``-`` is the standard input, which counts as a file of the working folder."""
        placed = self._search.placed(Path(name))
        near = self._near(placed)
        settings = near.settings_of(placed).with_options(
            {**self._options, **self._dialect(near), **self._machine(near), **self._technology}
        )
        _ = settings.demands  # settings that contradict each other are texts before the first file
        baseline = self._baseline(near)
        of_file = baseline.of(placed) if baseline else {}
        known = frozenset(mark for mark, code in of_file.items() if code not in CODES or settings.shows(code))
        if name == STDIN:
            return Job("<stdin>", read_stdin(), settings, known)
        return Job(name, Path(name), settings, known)

    def near(self, name: str) -> SettingsFile:
        """The settings file that counts for a file, with what options say in its place of which files are checked."""
        near, options = self._near(self._search.placed(Path(name))), self._asked
        return replace(
            near,
            exclude=near.exclude if self._exclude is None else self._exclude,
            include=near.include if self._include is None else self._include,
            baseline=None if options.write_baseline else options.baseline or near.baseline,
        )

    def _dialect(self, near: SettingsFile) -> dict[str, Any]:
        """The dialect that the command line names, which settings may define."""
        name = self._asked.dialect
        if not isinstance(name, str) or not name:
            return {}
        return {"dialect": chosen_dialect(name, Path(), near.dialects, "--dialect")}

    def _machine(self, near: SettingsFile) -> dict[str, Any]:
        """The machine that the command line names, of which settings may have the file."""
        name = self._asked.machine
        if name is None:
            return {}
        if near.machines not in self._machines:
            from sim.setup.machine.machine import load_machine

            self._machines[near.machines] = load_machine(name, own=near.machines)
        return {"machine": self._machines[near.machines]}

    @cached_property
    def _technology(self) -> dict[str, Any]:
        """The technology that the command line names."""
        if self._asked.technology is None:
            return {}
        from sim.setup.technology import load_technology

        return {"technology": load_technology(self._asked.technology)}

    def _near(self, placed: Path) -> SettingsFile:
        return self._only or self._search.near(placed.parent)

    def _baseline(self, near: SettingsFile) -> "Baseline | None":
        path = self._asked.baseline or near.baseline
        if path is None or self._asked.write_baseline:
            return None
        from sim.check.silence import read_baseline

        path = self._search.placed(path)
        if path not in self._baselines:
            self._baselines[path] = read_baseline(path)
        return self._baselines[path]


def _settings(options: CheckOptions) -> dict[str, Any]:
    """Settings that the command line gives, in place of those of the files."""
    given: dict[str, Any] = {}
    lengths, work = options.lengths, options.work
    if options.select is not None:
        given["select"] = code_list(options.select.split(","), "--select")
    if options.ignore is not None:
        given["ignore"] = code_list(options.ignore.split(","), "--ignore")
    if options.fail_on is not None:
        given["fail_on"] = mildest_failing(options.fail_on, "--fail-on")
    given |= {field: key.of_option(lengths[key.name]) for field, key in WIRE_LENGTHS.items() if key.name in lengths}
    given |= {field: key.of_option(work[key.name]) for field, key in _OF_WORK.items() if key.name in work}
    if options.taper is not None:
        given["taper"] = options.taper
    if options.may_stay_open:
        given["may_stay_open"] = True
    read_with = {"dialect": options.dialect, "unit": options.unit, "registers": merged([options.offset])}
    return {**given, **{field: value for field, value in read_with.items() if value}}


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
