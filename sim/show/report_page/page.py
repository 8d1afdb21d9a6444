"""The whole page of a run.

What it takes to run the same again: versions, the program's check sum, and the files beside it.

All settings of a run for people: by section, with names and units.
"""

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

from markupsafe import Markup

from parser.dialect.reader import OwnDialect
from parser.findings.catalogue import LANGUAGES, Bilingual
from parser.program import Program, own_dialect_text
from parser.text.encoding import decode_text, encode_text
from sim.base.workers.maker import Maker, versions
from sim.cut.pieces.pieces import Pieces
from sim.run.dryrun import DryRun
from sim.run.findings import outcome
from sim.run.recording import NO_PIECES
from sim.run.report.model import ReportDocument
from sim.run.sparks import has_panel
from sim.setup.dialect import OWN_SUFFIX
from sim.setup.expectations import EXPECT, Expectation, wanted
from sim.setup.key_words import title_of, value_word, words_of
from sim.setup.machine.machine import Machine, machine_sections
from sim.setup.quiz import QUIZ
from sim.setup.scenario import MACHINE_FILE, TECHNOLOGY_FILE, Scenario, scenario_sections
from sim.setup.technology import technology_sections
from sim.setup.toml.keys import Key, Section, WrittenSection, toml_text, toml_value
from sim.setup.toml.kinds import Keys, OneOf
from sim.show.draw.style import DARK, OF_LEANS, Theme, hexadecimal
from sim.show.html.environment import rendered
from sim.show.html.walls import walls_entry
from sim.show.pictures.inline import Inline
from sim.show.refusals import machine_values, taken_for_granted
from sim.show.report_page.figures import key_figures, time_figures, why
from sim.show.report_page.findings import explained, inline, shown_findings
from sim.show.report_page.results import (
    block_table,
    cause_table,
    check_table,
    contour_table,
    deviation_table,
    limit_table,
    loss_table,
    pass_table,
    spark_tables,
    taper_tables,
    technology_table,
)
from sim.show.report_page.sheet import MOST_THREADS, sheet_of, thread_table
from sim.show.report_page.tables import (
    Column,
    ReportTable,
    corner_table,
    piece_table,
    size_tables,
    worst_table,
    yes_or_no,
)
from sim.show.texts import bilingual
from sim.show.texts.phrases import machine_name, same


class Setting(NamedTuple):
    """One setting: its name and its key, its value and unit."""

    name: Bilingual
    key: str
    value: Bilingual
    unit: str


class SettingGroup(NamedTuple):
    """Settings of one section."""

    title: Bilingual
    settings: tuple[Setting, ...]


def setting_groups(scenario: Scenario, program: Program) -> list[SettingGroup]:
    """Settings of program, machine, wire, work and what was asked of them.

    Expectations have a table of their own, and the quiz is the replay's.
    """
    whole, *parts = scenario_sections(scenario)
    named, *of_machine = machine_sections(scenario.machine)
    settings = {setting.key: setting for setting in (*_settings(whole), *_settings(named))}
    del settings["machine"], settings["name"]  # shown by its own sections, and beside the time
    settings.pop("title_zh", None)  # it is the title in Chinese
    settings.pop("name_zh", None)  # the head has it
    settings.pop("program", None)  # shown by its name alone
    read = (
        settings.pop("title")._replace(value=Bilingual(*map(scenario.title_in, LANGUAGES))),
        settings.pop("provenance"),
        _program(whole.section, program),
        _found("encoding", program.encoding),
        _found("dialect", program.reading.dialect),
    )
    return [
        SettingGroup(bilingual("report.section-program"), read),
        *_groups(part for part in parts if part.section not in (QUIZ, EXPECT)),
        SettingGroup(bilingual("report.section-run"), tuple(settings.values())),
        *_groups(of_machine),
    ]


def _program(top: Section, program: Program) -> Setting:
    """The name of the program, whichever section tells of its file."""
    key = next(key for key in top.keys if key.name == "program")
    return Setting(words_of(top, key).name, key.name, same(program.name), key.kind.unit)


def _found(key: str, value: str) -> Setting:
    """What was found out about the program, beside what was set."""
    return Setting(bilingual(f"report.{key}"), key, same(value), "")


def _groups(sections: Iterable[WrittenSection]) -> list[SettingGroup]:
    return [SettingGroup(title_of(part.section), _settings(part)) for part in sections if part.values]


def _settings(written: WrittenSection) -> tuple[Setting, ...]:
    return tuple(_setting(written.section, key, written.values[key.name]) for key in written.keys)


def _setting(section: Section, key: Key, value: Any) -> Setting:
    is_word = isinstance(key.kind, OneOf) and value in key.kind.words  # a dialect of a shop's own is none
    text = value_word(value) if is_word else machine_values(value) if isinstance(key.kind, Keys) else _value(value)
    return Setting(words_of(section, key).name, key.name, text, key.kind.unit)


def _value(value: Any) -> Bilingual:
    if isinstance(value, bool):
        return bilingual("report.yes" if value else "report.no")
    if isinstance(value, Mapping):
        return same(", ".join(f"{name} = {number:.10g}" for name, number in value.items()))
    if isinstance(value, list) and isinstance(value[0], str):
        return same(", ".join(value))
    if isinstance(value, list):
        return same("; ".join(", ".join(f"{number:.10g}" for number in pair) for pair in _pairs(value)))
    return same(f"{value:.10g}" if isinstance(value, float) else value)


def _pairs(value: list[Any]) -> list[list[float]]:
    return value if isinstance(value[0], list) else [value]


class Reproduction(NamedTuple):
    """How to run the same again.

    Attributes
    ----------
    command
        The command line, for a folder that holds the program and the files.
    program, sha256
        Name of the program, and the check sum of its bytes.
    files
        Name and content of the files beside the program.
    versions
        Of drycut, Python and the packages.
    """

    command: str
    program: str
    sha256: str
    files: tuple[tuple[str, str], ...]
    versions: Maker


def reproduction(run: DryRun) -> Reproduction:
    """What makes the same run again."""
    data = encode_text(run.program.text, run.program.encoding)
    scenario = run.scenario
    return Reproduction(
        command="drycut run . -o out" + _engine(scenario.machine),
        program=run.program.name,
        sha256=hashlib.sha256(data).hexdigest(),
        files=(
            ("scenario.toml", toml_text(scenario_sections(scenario))),
            (MACHINE_FILE, toml_text(machine_sections(scenario.machine))),
            *_technology(scenario),
            *_upper(scenario),
            *_own_dialect(scenario),
        ),
        versions=versions(),
    )


def _technology(scenario: Scenario) -> tuple[tuple[str, str], ...]:
    """The file of the technology, where there is one."""
    technology = scenario.technology
    return () if technology is None else ((TECHNOLOGY_FILE, toml_text(technology_sections(technology))),)


def _upper(scenario: Scenario) -> tuple[tuple[str, str], ...]:
    """The program of an upper contour, where there is one."""
    upper = None if scenario.taper is None else scenario.taper.upper
    return () if upper is None else ((upper.name, decode_text(upper.data)[0]),)


def _own_dialect(scenario: Scenario) -> tuple[tuple[str, str], ...]:
    """The file of the dialect of a shop's own; none of a profile."""
    own = scenario.dialect
    return ((f"{own}{OWN_SUFFIX}", own_dialect_text(own)),) if isinstance(own, OwnDialect) else ()


def _engine(machine: Machine) -> str:
    """The option of another engine than the usual one, which no file asks for."""
    return "" if machine.engine == Machine._field_defaults["engine"] else f" --engine {machine.engine}"


_ASSETS: Final = Path(__file__).with_name("assets")


def report_page(
    run: DryRun,
    report: ReportDocument,
    pictures: Sequence[Inline],
    pieces: Pieces = NO_PIECES,
    *,
    has_trace: bool = False,
) -> str:
    """``report.html`` of a run; `report` is its ``report.json``, whose figures the page shows.

    `pieces` are what the cut leaves, for their weight; with `has_trace` a ``trace.npz`` stands beside the page, and
    beside that of a run under sparks a ``panel.html``.

    Everything that comes from a program, a file name or a scenario stands escaped. The same run gives the same bytes.
    """
    findings = shown_findings(run)
    tables = [table for table in _tables(run, report) if table.rows]
    shown_pictures = {
        picture.name: {language: Markup(svg) for language, svg in picture.svg.items()}  # noqa: S704 - escaped by svg.py
        for picture in pictures
    }
    return rendered(
        _ASSETS,
        "report.html.j2",
        title=run.scenario.titles,
        program=run.program.name,
        inline=inline,
        verdict=outcome(run.findings),
        verdict_word=bilingual(f"report.{outcome(run.findings)}"),
        why=why(run),
        granted=taken_for_granted(run),
        figures=key_figures(run, report),
        times=time_figures(report),
        technology_is_assumed=run.scenario.technology is None,
        findings=findings,
        unshown=len(run.findings) - len(findings),
        explained=explained(run.findings),
        pictures=list(shown_pictures.items()),
        cut=shown_pictures.get("cut"),
        sheet=sheet_of(run, report, pieces),
        tables={table.name: table for table in tables},
        tables_data=[table.data() for table in tables],
        groups=setting_groups(run.scenario, run.program),
        has_trace=has_trace,
        has_panel=has_panel(run),
        walls=walls_entry(run.tilted),
        machine=machine_name(run.scenario.machine),
        reproduction=reproduction(run),
        dark_pictures=_recoloured(DARK, leans=run.tilted is not None),
    )


def _tables(run: DryRun, report: ReportDocument) -> list[ReportTable]:
    remains, drawing, names = report["remains"], report["drawing"], run.block_names
    threads = report["thread_points"]
    return [
        *([thread_table(threads, names)] if len(threads) > MOST_THREADS else []),
        contour_table(run, report),
        *([pass_table(run, report)] if run.has_trims else []),
        technology_table(report),
        deviation_table(run, report),
        cause_table(run, report),
        limit_table(run, report),
        loss_table(run, report),
        *taper_tables(report),
        *spark_tables(run, report),
        *([piece_table(remains["pieces"], names), *size_tables(remains["sizes"], names)] if remains else []),
        *([worst_table(drawing["worst"], names), corner_table(drawing["unreachable"], names)] if drawing else []),
        block_table(run, report),
        check_table(run),
        _expectation_table(run),
    ]


def _expectation_table(run: DryRun) -> ReportTable:
    """What the scenario expects, and whether the run meets it: those that it does not are findings."""
    expected: tuple[Expectation, ...] = run.scenario.expect
    missed = {each.expected.path for each in run.missed}
    return ReportTable(
        "expectations",
        (
            Column(bilingual("report.path"), [each.path for each in expected], "code"),
            Column(bilingual("report.wanted"), [toml_value(wanted(each)) for each in expected], "code"),
            yes_or_no("met", [each.path not in missed for each in expected]),
        ),
    )


def _recoloured(theme: Theme, *, leans: bool) -> Markup:
    """Rules of a style sheet that show pictures in the colours of a theme."""
    rule = Markup(".f-{0}{{fill:{1}}}.s-{0}{{stroke:{1}}}")
    paints = {paint: colour for paint, colour in theme.items() if leans or paint not in OF_LEANS}
    return Markup("\n").join(rule.format(paint, hexadecimal(colour)) for paint, colour in paints.items())
