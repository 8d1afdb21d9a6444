"""The reader of 3B and 4B, as the door of the parser asks for it."""

import numpy as np

from parser.dialect.reader import BlockCounts, Choices, Damage, Reading, ReadText, Spelling
from parser.findings.codes import Check
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, TooLarge, file_order, telling
from parser.step_words.words import SENSES
from parser.text.encoding import narrow, no_program
from parser.threeb.block_checks import (
    block_findings,
    damaged_after,
    dialect,
    lost_blocks,
    order_findings,
)
from parser.threeb.columns import RawBlocks
from parser.threeb.decode import decode
from parser.threeb.mend import MENDER
from parser.threeb.print_checks import print_findings
from parser.threeb.reader import Records, read_records
from parser.threeb.tokens import BLOCK_WORDS, LIKE_A_BLOCK, OWN_MARKS
from parser.toolpath import Toolpath

_SPELLING = Spelling(SENSES[-1], SENSES[1], end=OWN_MARKS.end[0], pause=OWN_MARKS.pause[0])


class ThreeB:
    """3B as the trade writes it, and 4B as the trade recalls it (docs/3b.md)."""

    name = "3B"
    suffixes = (".3b", ".4b")
    own_marks = OWN_MARKS
    block_words = BLOCK_WORDS

    def recognises(self, text: str) -> bool:
        """Whether a text holds a block, or what was meant for one."""
        folded = narrow(text)
        if "B" not in folded and "b" not in folded:  # as in most programs of ISO, where the pattern would take long
            return False
        return bool(LIKE_A_BLOCK.search(text) or (not text.isascii() and LIKE_A_BLOCK.search(folded)))

    def read(self, text: str, choices: Choices) -> ReadText:
        """What a text says. ProgramError (3B100) where it holds no block."""
        marks = choices.marks
        records = read_records(text, marks)
        whole = len(records.blocks.line)
        if not whole:
            raise ProgramError(no_program("no-block"), others=records.findings)
        records, after_end, behind = _up_to_end(records)
        found = whole + behind + sum(damage.is_block for damage in records.damages)
        toolpath = decode(records)
        findings = [*records.findings, *after_end, *order_findings(records, toolpath, marks)]
        if not any(telling(findings, TooLarge)):
            damaged = np.array([damage.span[0] for damage in records.damages], dtype=np.int64)
            findings += block_findings(toolpath, records.lines)
            findings += print_findings(toolpath, records.header, records.lines, damaged)
        counts = BlockCounts(found, whole, len(records.blocks.line))
        ordered = tuple(sorted(findings, key=file_order))
        return ReadText(
            records.lines, _reading(records, toolpath, counts), records.header.values, toolpath, ordered, MENDER
        )


THREE_B = ThreeB()


def _reading(records: Records, toolpath: Toolpath, counts: BlockCounts) -> Reading:
    name = dialect(records)
    not_asked = {}
    if np.isnan(toolpath.printed_end_um).all():
        not_asked[Check.PRINTED_ENDS] = "reason-no-prints"
    if not records.header.lengths and records.header.offset_um is None:
        not_asked[Check.HEADER] = "reason-no-header"
    return Reading(
        dialect=name,
        counts=counts,
        damages=tuple(Damage(damage.span, damage.after) for damage in records.damages),
        spelling=_SPELLING,
        # 4B, and a CAXA program with an offset of 0, run on the drawing's contour; the controller offsets it.
        is_drawing=name == "4B" or records.header.offset_um == 0.0,
        not_asked=not_asked,
        offset_span=records.header.offset_span,
        remarks=records.remarks,
    )


def _up_to_end(records: Records) -> tuple[Records, list[Finding], int]:
    """Records up to the end code; finding 3B103 where blocks stand after it; and how many of these are damaged.

    Marks before the first block are words of the header.
    """
    marks = tuple(mark for mark in records.marks if mark.after > 0 or mark.kind == "node")
    end = next((mark for mark in marks if mark.kind == "end"), None)
    if end is None:
        return records._replace(marks=marks), [], 0
    first = end.span[0]
    up_to_end = records._replace(
        blocks=RawBlocks._make(column[: end.after] for column in records.blocks),
        marks=marks[: marks.index(end) + 1],
        damages=tuple(damage for damage in records.damages if damage.span[0] < first),
        findings=tuple(finding for finding in records.findings if finding.span[0] < first),
    )
    return up_to_end, lost_blocks(records, end), len(damaged_after(records, end))
