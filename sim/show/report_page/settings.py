"""All settings of a run for people: by section, with names and units."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from parser.findings.catalogue import Said
from parser.program import Program
from sim.setup.expectations import EXPECT
from sim.setup.key_words import title_of, value_word, words_of
from sim.setup.machine.machine import machine_sections
from sim.setup.quiz import QUIZ
from sim.setup.scenario import Scenario, scenario_sections
from sim.setup.toml.keys import Key, Section, WrittenSection
from sim.setup.toml.kinds import OneOf
from sim.show.words import said
from sim.show.words.phrases import same


class Setting(NamedTuple):
    """One setting: its name and its key, its value and unit."""

    name: Said
    key: str
    value: Said
    unit: str


class SettingGroup(NamedTuple):
    """Settings of one section."""

    title: Said
    settings: tuple[Setting, ...]


def setting_groups(scenario: Scenario, program: Program) -> list[SettingGroup]:
    """Settings of program, machine, wire, work and what was asked of them.

    Expectations have a table of their own, and the quiz is the replay's.
    """
    whole, *parts = scenario_sections(scenario)
    named, *of_machine = machine_sections(scenario.machine)
    settings = {setting.key: setting for setting in (*_settings(whole), *_settings(named))}
    del settings["machine"], settings["name"]  # shown by its own sections, and beside the time
    settings.pop("program", None)  # shown by its name alone
    read = (
        settings.pop("title"),
        settings.pop("provenance"),
        _program(whole.section, program),
        _found("encoding", program.encoding),
        _found("dialect", program.reading.dialect),
    )
    return [
        SettingGroup(said("report.section-program"), read),
        *_groups(part for part in parts if part.section not in (QUIZ, EXPECT)),
        SettingGroup(said("report.section-run"), tuple(settings.values())),
        *_groups(of_machine),
    ]


def _program(top: Section, program: Program) -> Setting:
    """The name of the program, whichever section tells of its file."""
    key = next(key for key in top.keys if key.name == "program")
    return Setting(words_of(top, key).name, key.name, same(program.name), key.kind.unit)


def _found(key: str, value: str) -> Setting:
    """What was found out about the program, beside what was set."""
    return Setting(said(f"report.{key}"), key, same(value), "")


def _groups(sections: Iterable[WrittenSection]) -> list[SettingGroup]:
    return [SettingGroup(title_of(part.section), _settings(part)) for part in sections if part.values]


def _settings(written: WrittenSection) -> tuple[Setting, ...]:
    return tuple(_setting(written.section, key, written.values[key.name]) for key in written.keys)


def _setting(section: Section, key: Key, value: Any) -> Setting:
    shown = value_word(value) if isinstance(key.kind, OneOf) else _value(value)
    return Setting(words_of(section, key).name, key.name, shown, key.kind.unit)


def _value(value: Any) -> Said:
    if isinstance(value, bool):
        return said("report.yes" if value else "report.no")
    if isinstance(value, Mapping):
        return same(", ".join(f"{name} = {number:.10g}" for name, number in value.items()))
    if isinstance(value, list) and isinstance(value[0], str):
        return same(", ".join(value))
    if isinstance(value, list):
        return same("; ".join(", ".join(f"{number:.10g}" for number in pair) for pair in _pairs(value)))
    return same(f"{value:.10g}" if isinstance(value, float) else value)


def _pairs(value: list[Any]) -> list[list[float]]:
    return value if isinstance(value[0], list) else [value]
