"""The reader of ISO, as the door of the parser asks for it."""

import re

from parser.dialect.reader import BlockCounts, Choices, Marks, Reading, ReadText, Spelling
from parser.findings.codes import Check
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, file_order
from parser.geometry.curves import Ints
from parser.iso.lexer import read_listing
from parser.iso.motion import moved
from parser.iso.telling import assumption_findings, told
from parser.iso.text_checks import checked
from parser.iso.trace import Trace
from parser.text.encoding import narrow, no_program

_LIKE_A_BLOCK = re.compile(r"(?im)^[ \t/]*(?:N[ \t]*\d+[ \t]*)?(?:[A-Z][ \t]*[-+]?[\d.]+[ \t]*)*?G[ \t]*\d")
_CODES = {
    "3B211": "ISO219",
    "3B301": "ISO300",
    "3B306": "ISO219",
    "3B307": "ISO305",
    "3B312": "ISO307",
    "3B316": "ISO308",
    "3B401": "ISO304",
    "3B501": "ISO504",
    "3B502": "ISO505",
    "3B503": "ISO506",
    "3B504": "ISO507",
}


class Iso:
    """G-code as wire-cut machines are told it, in the dialects that have a profile (docs/iso.md)."""

    name = "ISO"
    suffixes = (".iso", ".nc", ".cnc")
    own_marks = Marks()
    block_words = ()

    def recognises(self, text: str) -> bool:
        """Whether a text holds a line with a G word, or what was meant for one."""
        return bool(_LIKE_A_BLOCK.search(narrow(text)))

    def read(self, text: str, choices: Choices) -> ReadText:
        """What a text says. ProgramError (ISO100) where it holds no block."""
        listing = read_listing(text)
        if not len(listing.blocks.line):
            raise ProgramError(no_program("no-block"))
        family = told(listing, choices)
        listing = checked(listing, family.profile)
        path = moved(listing, family.profile, choices)
        n = len(path.toolpath)
        reading = Reading(
            dialect=f"ISO {family.profile.name}",
            counts=BlockCounts(n + len({one.block for one in listing.unread}), n, n),
            damages=path.damages,
            spelling=Spelling(clockwise="G02", counter_clockwise="G03", end="M02", rapid="G00"),
            is_drawing=path.toolpath.compensation is not None,
            not_asked={Check.PRINTED_ENDS: "reason-no-prints", Check.HEADER: "reason-no-header"},
            remarks=listing.remarks,
            assumptions=(*family.assumptions, *path.assumptions),
            codes=_CODES,
        )
        of_text = (_by_row(finding, path.first_row) for finding in (*listing.findings, *assumption_findings(family)))
        findings = tuple(sorted([*of_text, *path.findings], key=file_order))
        decoder = Trace(listing, family.profile, choices)
        return ReadText(listing.lines, reading, {}, path.toolpath, findings, decoder=decoder)


def _by_row(finding: Finding, first_row: Ints) -> Finding:
    """A finding at a block of the text as one at the row that the block makes when it first runs, if it makes one."""
    return finding._replace(block=int(first_row[finding.block - 1]) + 1 if finding.block else 0)


ISO = Iso()
