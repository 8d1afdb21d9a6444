"""A text as an editor has it open."""

from dataclasses import dataclass
from functools import cached_property

from parser.findings.catalogue import Language
from parser.findings.findings import Edit
from sim.check.as_typed import AsTyped
from sim.check.mended import mended_text
from sim.serve.editor.places import Places


@dataclass(frozen=True, eq=False)
class Text:
    """A text as an editor has it: what was made of it, its places, and the language for people.

    `version` is the editor's number of this state of the text; None where it gives none, or its edits bear none.
    """

    uri: str
    version: int | None
    opened: AsTyped
    places: Places
    language: Language

    @cached_property
    def mends(self) -> tuple[Edit, ...]:
        """The edits of ``drycut check --fix``, worked out once; none where nothing is certain."""
        program = self.opened.program
        if program is None or not any(finding.edits for finding in self.opened.result.findings):
            return ()  # editors ask at every move of the caret
        return mended_text(program, self.opened.settings).edits
