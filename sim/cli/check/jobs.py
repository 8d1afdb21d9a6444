"""The jobs of a check: its files, each with the settings that count for it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import click

from parser.dialect.reader import ChosenDialect, merged
from parser.files import read_stdin
from parser.findings.codes import CODES
from parser.findings.errors import Message
from sim.check.file_check import Job
from sim.check.files import STORED, FileFilter, find_files
from sim.check.settings.model import WIRE_LENGTHS
from sim.check.settings.read import (
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
