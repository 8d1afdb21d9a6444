"""All settings of a run for people: by section, with names and units."""

from collections.abc import Iterable
from typing import Any, NamedTuple

from parser.findings.catalogue import Said
from parser.program import Program
from sim.setup.machine.machine_file import machine_sections
from sim.setup.scenario import Scenario
from sim.setup.scenario_file import scenario_sections
from sim.setup.toml.writer import Section
from sim.show.words import said
from sim.show.words.phrases import same

_UNITS = {
    "_mm2_min": "mm²/min",
    "_n_s_mm": "N s/mm",
    "_g_cm3": "g/cm³",
    "_mm_s3": "mm/s³",
    "_mm_s2": "mm/s²",
    "_mm_s": "mm/s",
    "_n_um": "N/µm",
    "_n_mm": "N/mm",
    "_mm": "mm",
    "_um": "µm",
    "_us": "µs",
    "_ms": "ms",
    "_kg": "kg",
    "_hz": "Hz",
    "_deg": "°",
    "_n": "N",
}
"""Units by the ends of keys, longer ones first."""

_CHOSEN = ("interpolator", "junction", "kind", "side")
"""Keys whose values are words of the settings' own."""


class Setting(NamedTuple):
    """One setting: its name and its key, its value and unit."""

    name: Said
    key: str
    value: Said
    unit: str


class Group(NamedTuple):
    """Settings of one section."""

    title: Said
    settings: tuple[Setting, ...]


def setting_groups(scenario: Scenario, program: Program) -> list[Group]:
    """Settings of program, machine, wire, work and what was asked of them.

    Expectations have a table of their own, and the quiz is the replay's.
    """
    whole, *parts = scenario_sections(scenario)
    _, *of_machine = machine_sections(scenario.machine)
    read = {"title": scenario.title, "provenance": scenario.provenance, "program": program.name}
    read |= {"encoding": program.encoding, "dialect": program.reading.dialect}
    asked = {key: value for key, value in whole[1].items() if key not in {*read, "machine"}}
    shown = [("program", read), *_keyed(parts), ("run", asked), *_keyed(of_machine)]
    return [_group(name, section) for name, section in shown if section]


def _keyed(sections: Iterable[tuple[str, Section]]) -> list[tuple[str, Section]]:
    return [(header.strip("[]"), section) for header, section in sections if header not in ("[expect]", "[[quiz]]")]


def _group(name: str, section: Section) -> Group:
    return Group(said(f"report.section-{name}"), tuple(_setting(key, value) for key, value in section.items()))


def _setting(key: str, value: Any) -> Setting:
    unit = next((unit for end, unit in _UNITS.items() if key.endswith(end)), "")
    shown = said(f"report.value-{value}") if key in _CHOSEN else _value(value)
    return Setting(said(f"report.set-{key}"), key, shown, unit)


def _value(value: Any) -> Said:
    if isinstance(value, bool):
        return said("report.yes" if value else "report.no")
    if isinstance(value, list):
        return same("; ".join(", ".join(f"{number:.10g}" for number in pair) for pair in _pairs(value)))
    return same(f"{value:.10g}" if isinstance(value, float) else value)


def _pairs(value: list[Any]) -> list[list[float]]:
    return value if isinstance(value[0], list) else [value]
