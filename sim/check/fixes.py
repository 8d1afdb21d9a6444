"""Certain mends of findings, as edits of the program's text."""

import re
from collections import Counter
from collections.abc import Callable
from itertools import islice
from typing import NamedTuple

import numpy as np

from controller.stepping.words import words_of
from parser.dialect.mender import Mender
from parser.findings.findings import Edit, Finding
from parser.program import Program
from parser.text.source import Field
from parser.toolpath import Axis
from sim.check.count_axes import count_on
from sim.check.engine import Checked
from sim.check.proofs import Proofs

_MOST_PRINTED = 50  # printed ends that are mended; where more are wrong, it is not by slips in single blocks
_LINE_END = re.compile(r"\r\n|\r|\n")
_SETTLED = (Field.COUNT, Field.AXIS)
"""Fields that a printed end settles: the others shape the path on the way to it too."""
_LETTERS = {Field.X.term: "X ", Field.Y.term: "Y ", Field.COUNT.term: "J "}


class Choice(NamedTuple):
    """A possible mend: the block, and what one of its fields would say."""

    block: int
    text: str


def with_edits(program: Program, checked: Checked) -> tuple[Finding, ...]:
    """All findings of a program, each with the edits that certainly mend it; one may make another uncertain."""
    if program.mender is None:
        return checked.findings
    known = _Known(program, program.mender, checked)
    makers: dict[str, Callable[[Finding], tuple[Edit, ...]]] = {
        "3B102": known.end_code,
        "3B203": known.label,
        "3B204": known.count_axis,
        "3B207": known.printed_end,
        "3B208": known.swapped_axis,
        "3B304": known.suspect,
    }
    return tuple(
        finding._replace(edits=makers[finding.code](finding)) if finding.code in makers else finding
        for finding in checked.findings
    )


def choices(program: Program, finding: Finding, findings: tuple[Finding, ...]) -> tuple[Choice, ...]:
    """Mends of a finding, each enough alone; one or none leave no choice."""
    if finding.code == "3B207" and program.mender is not None:
        misprinted = (f for f in findings if f.code == "3B207")
        if next(islice(misprinted, _MOST_PRINTED, None), None):
            return ()
        possible = program.mender.printed_mends(program.toolpath, finding.block - 1)
        return tuple(Choice(finding.block, _LETTERS.get(field.term, "") + text) for field, text in possible)
    if finding.code == "3B203" and not finding.edits:
        others = [f.values["other"] for f in findings if f.code == "3B304" and _is_at_label(f, finding)]
        return tuple(Choice(finding.block, str(text)) for text in (finding.values["ruled"], *others))
    if finding.code == "3B204" and not finding.edits:
        axis, count = f"G{finding.values['ruled']}", int(finding.values["count"])
        other = (Choice(finding.block, f"{axis} J {count}"),) if count != _count(program, finding) else ()
        return (Choice(finding.block, axis), *other)
    if finding.code == "3B301":
        suspected = _suspects(finding, findings)
        return tuple(
            Choice(f.block, f"{_LETTERS.get(str(f.values['field']), '')}{f.values['other']}") for f in suspected
        )
    return ()


class _Known:
    """What is known of a program: where its blocks end for certain, and who is suspected where they do not."""

    def __init__(self, program: Program, mender: Mender, checked: Checked) -> None:
        self._program, self._mender = program, mender
        self._words = words_of(program.toolpath)
        self._proofs = Proofs(program, mender, checked)
        self._misprinted = sum(finding.code == "3B207" for finding in checked.findings)
        self._opens = {finding.values["first"] for finding in checked.findings if finding.code == "3B301"}
        self._suspects = Counter(f.values["first"] for f in checked.findings if f.code == "3B304")

    def end_code(self, finding: Finding) -> tuple[Edit, ...]:
        """The end code on a line of its own behind all that is written, with the line end that the first line has.

        Nothing where something unreadable stands behind the last whole block: the program may go on there.
        """
        text, reading = self._program.text, self._program.reading
        if any(damage.after >= reading.counts.run for damage in reading.damages):
            return ()
        at = len(text.rstrip("\x1a\0"))  # DOS ends a text with the one, and fills its last sector with the other
        match = _LINE_END.search(text)
        newline, end = match[0] if match else "\n", reading.spelling.end
        return (Edit(at, at, f"{end}{newline}" if text[:at].endswith(("\r", "\n")) else f"{newline}{end}"),)

    def label(self, finding: Finding) -> tuple[Edit, ...]:
        """The quadrant digit that the rule names: the path stays the same. Nothing where that path is in doubt."""
        return (_digit(finding),) if self._proofs.label_is_certain(finding.block) else ()

    def count_axis(self, finding: Finding) -> tuple[Edit, ...]:
        """The other axis, with the J that ends the block where it ends; nothing where that end is not proved."""
        row = finding.block - 1
        if not self._proofs.end_is_proved(finding.block):
            return ()
        toolpath = self._program.toolpath
        axis = Axis[str(finding.values["ruled"])]
        count = int(count_on(toolpath, np.array([row]), np.array([int(axis)]))[0])
        edits = [self._field(row, Field.AXIS, axis.name)]
        if count != self._words.count_um[row]:
            edits.append(self._field(row, Field.COUNT, str(count)))
        return tuple(edits)

    def printed_end(self, finding: Finding) -> tuple[Edit, ...]:
        """The one count length or count axis with which the block ends where it is printed to end.

        Nothing where the printed end may be what is wrong: the next one, or a closed contour, tells.
        """
        if self._misprinted > _MOST_PRINTED:
            return ()
        misprint = self._mender.is_misprint(self._program.toolpath, finding.block - 1)
        if misprint is None:
            misprint = not self._proofs.is_open(finding.block)
        if misprint:
            return ()
        possible = self._mender.printed_mends(self._program.toolpath, finding.block - 1)
        if len(possible) != 1 or possible[0].field not in _SETTLED:
            return ()
        field, text = possible[0]
        return (self._field(finding.block - 1, field, text.removeprefix("G")),)

    def swapped_axis(self, finding: Finding) -> tuple[Edit, ...]:
        """The other axis, where J is the line's length on that one to the micrometre."""
        row = finding.block - 1
        words = self._words
        x, y, count = int(words.x_um[row]), int(words.y_um[row]), int(words.count_um[row])
        other = Axis.Y if words.count_axis[row] == Axis.X else Axis.X
        swapped = count == max(x, y) == (x if other == Axis.X else y)
        return (self._field(row, Field.AXIS, other.name),) if swapped else ()

    def suspect(self, finding: Finding) -> tuple[Edit, ...]:
        """The count axis of the only suspect of an open contour."""
        contour = finding.values["first"]
        alone = self._suspects[contour] == 1 and contour in self._opens
        if not alone or finding.values["field"] != "field-axis":
            return ()
        return (self._field(finding.block - 1, Field.AXIS, str(finding.values["other"]).removeprefix("G")),)

    def _field(self, row: int, field: Field, text: str) -> Edit:
        span = self._program.toolpath.source.field(row, field)
        if span is None:
            raise ValueError(f"row {row} has no {field}")
        low, high = span
        return Edit(high - 1 if field is Field.AXIS else low, high, text)


def _digit(finding: Finding) -> Edit:
    past = finding.span[1]
    return Edit(past - 1, past, str(finding.values["ruled"])[-1])


def _count(program: Program, finding: Finding) -> int:
    return int(words_of(program.toolpath).count_um[finding.block - 1])


def _is_at_label(suspect: Finding, label: Finding) -> bool:
    return suspect.block == label.block and suspect.values["field"] == "field-sense"


def _suspects(contour: Finding, findings: tuple[Finding, ...]) -> list[Finding]:
    return [f for f in findings if f.code == "3B304" and f.values["first"] == contour.values["first"]]
