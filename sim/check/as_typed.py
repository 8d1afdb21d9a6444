"""A text as it is typed, read and checked with the settings that count for its file; it may hold no program yet."""

from pathlib import Path
from typing import Final, NamedTuple

from parser.findings.errors import DrycutError, ProgramError
from parser.program import Program, load_program
from parser.text.lines import LineIndex
from sim.check.batch import Job, check_file, check_program
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.check.settings.read import NO_SETTINGS
from sim.check.settings.search import SettingsSearch

_BOM: Final = "\ufeff"


class AsTyped(NamedTuple):
    """A text, read and checked.

    Attributes
    ----------
    lines
        Of the text as it is typed; each of its characters has its place in what was read of it.
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


def as_typed(name: str, file: Path | None, text: str) -> AsTyped:
    """Read and check a text under a name; `file` is where it stands, None where it stands nowhere yet."""
    settings, wrong = settings_near(name, file)
    # Characters keep their places: a mark of the byte order is a blank, half a pair a question mark.
    plain = f" {text[1:]}" if text.startswith(_BOM) else text
    data = plain.encode("utf-8", "replace")
    try:
        program = load_program(data, name, settings.choices)
    except ProgramError:
        return AsTyped(LineIndex(text), settings, None, check_file(Job(name, data, settings)), wrong)
    # Not the lines of the program: its reader folds full-width signs, which are shorter then in UTF-8.
    return AsTyped(LineIndex(text), settings, program, check_program(program, settings), wrong)


def settings_near(name: str, file: Path | None) -> tuple[CheckSettings, str]:
    """The settings that count for a text under a name; why those near its file do not, empty where they do.

    `file` is where it stands; None where it stands nowhere yet: no settings count for it.
    """
    search = SettingsSearch()
    if file is None:
        return NO_SETTINGS.settings_of(search.working / name), ""
    placed = search.placed(file)
    try:
        settings = search.near(placed.parent).settings_of(placed)
        _ = settings.demands  # settings that contradict each other are told here
    except DrycutError as error:
        return NO_SETTINGS.settings_of(placed), error.message
    return settings, ""
