"""A text as an editor has it open."""

from dataclasses import dataclass
from functools import cached_property

from parser.findings.catalogue import Language
from sim.check.as_typed import AsTyped
from sim.check.mended import mended_text
from sim.editor.places import Places


@dataclass(frozen=True, eq=False)
class Text:
    """A text as an editor has it: its name there, what was made of it, its places, and the language for people."""

    uri: str
    opened: AsTyped
    places: Places
    language: Language

    @cached_property
    def mended(self) -> str | None:
        """The text as ``drycut check --fix`` mends it, worked out once; None where nothing is certain."""
        program = self.opened.program
        if program is None or not any(finding.edits for finding in self.opened.result.findings):
            return None  # editors ask at every move of the caret
        mended = mended_text(program, self.opened.settings).text
        return mended if mended != program.text else None
