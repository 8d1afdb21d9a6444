"""What is asked of the text of a program, as its writers take it."""

from parser.write.iso_choices import IsoChoices, iso_choices
from sim.convert.wanted import Wanted
from sim.setup.making import Language, Writing
from sim.setup.scenario import Scenario

_USUAL_DIALECT = "fast-wire"


def wanted_of(writing: Writing, language: Language, scenario: Scenario, name: str) -> Wanted:
    """How a program of this name is to be written for the machine of a scenario, whose dialect and unit ISO has.

    SettingsError where the dialect has no such numbers.
    """
    return Wanted(
        language=language,
        iso=_iso(writing, scenario) if language == "iso" else None,
        form=writing.form,
        keeps=writing.compensation == "kept",
        newline="\r\n" if writing.crlf else "\n",
        name=name,
        end_code=writing.end_code,
        pause_code=writing.pause_code,
        encoding=writing.encoding,
    )


def _iso(writing: Writing, scenario: Scenario) -> IsoChoices:
    unit = scenario.unit or None
    return iso_choices(scenario.dialect or _USUAL_DIALECT, unit, writing.decimals)  # type: ignore[arg-type]  # checked
