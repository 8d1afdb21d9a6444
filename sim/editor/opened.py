"""A text open in an editor, read and checked with the settings that count for its file."""

from pathlib import Path
from typing import NamedTuple

from parser.findings.catalogue import Language
from parser.findings.errors import DrycutError, ProgramError
from parser.program import Program, load_program
from parser.text.lines import LineIndex
from sim.check.batch import Job, check_file, check_program
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.check.settings.read import NO_SETTINGS
from sim.check.settings.search import SettingsSearch
from sim.editor.places import Places

_BOM = "\ufeff"


class Opened(NamedTuple):
    """A text, read and checked.

    Attributes
    ----------
    lines
        Of the text.
    settings
        With which it was checked.
    program
        None where the text holds none.
    result
        What its check says.
    wrong_settings
        Why the settings near its file do not count; empty where they do, or there are none.
    """

    lines: LineIndex
    settings: CheckSettings
    program: Program | None
    result: CheckResult
    wrong_settings: str


class Text(NamedTuple):
    """A text as an editor has it: its name there, what was made of it, its places, and the language for people."""

    uri: str
    opened: Opened
    places: Places
    language: Language


def opened(name: str, file: Path | None, text: str) -> Opened:
    """Read and check a text under a name; `file` is where it stands, None where it stands nowhere yet."""
    settings, wrong = _settings(name, file)
    # Characters keep their places: a mark of the byte order is a blank, half a pair stands for itself.
    plain = f" {text[1:]}" if text.startswith(_BOM) else text
    data = plain.encode("utf-8", "replace")
    try:
        program = load_program(data, name, settings.choices)
    except ProgramError:
        return Opened(LineIndex(plain), settings, None, check_file(Job(name, data, settings)), wrong)
    return Opened(program.lines, settings, program, check_program(program, settings), wrong)


def _settings(name: str, file: Path | None) -> tuple[CheckSettings, str]:
    search = SettingsSearch()
    if file is None:
        return NO_SETTINGS.settings_of(search.working / name), ""
    placed = search.placed(file)
    try:
        settings = search.near(placed.parent).settings_of(placed)
        _ = settings.demands  # settings that contradict each other are told here
    except DrycutError as error:
        return NO_SETTINGS.settings_of(placed), str(error)
    return settings, ""
