"""A dialect of three words that lives in the tests alone: ``go X Y``, ``arc X Y CX CY left|right`` and ``end``.

Places are absolute, in mm, and a program starts at (0, 0). A number and a colon before a word are its label: ``N7`` is
that of ``7: go 1 2``. Nothing in it counts steps, names quadrants or prints ends: what goes through drycut with it
needs no word of 3B.
"""

import re
from collections.abc import Mapping

import numpy as np

from parser.dialect.reader import BlockCounts, Choices, Damage, Marks, Reading, ReadText, Spelling
from parser.findings.codes import Check
from parser.findings.errors import ProgramError
from parser.findings.findings import file_order
from parser.geometry.curves import Floats, curves_between
from parser.text.encoding import no_program
from parser.text.source import Field, LineIndex, Source, Span
from parser.toolpath import Stop, Toolpath
from parser.units import from_mm

_NUMBER = r"(-?\d+(?:\.\d+)?)"
_BLOCK = re.compile(rf"go {_NUMBER} {_NUMBER}|arc {_NUMBER} {_NUMBER} {_NUMBER} {_NUMBER} (left|right)")
_LINE = re.compile(r"(?:(\d+): )?([^\n]+)")
_FIELDS = {1: Field.X, 2: Field.Y, 3: Field.X, 4: Field.Y, 7: Field.SENSE}


class TinyReader:
    """Reads the dialect."""

    name = "tiny"
    suffixes = (".tiny",)
    own_marks = Marks(end=("END",))
    block_words = ("GO", "ARC", "LEFT", "RIGHT")

    def recognises(self, text: str) -> bool:
        return re.search(r"^(?:\d+: )?(?:go|arc)\b", text, re.MULTILINE) is not None

    def read(self, text: str, choices: Choices) -> ReadText:
        lines = LineIndex(text)
        blocks: list[re.Match[str]] = []
        labels: list[str] = []
        damages: list[Damage] = []
        stops: list[Stop] = []
        for line in _LINE.finditer(text):
            block = _BLOCK.fullmatch(text, *line.span(2))
            if block:
                blocks.append(block)
                labels.append(f"N{line[1]}" if line[1] else "")
            elif line[2] == "end":
                stops.append(Stop("end", len(blocks), lines.line(line.start(2))))
                break
            else:
                damages.append(Damage(line.span(2), len(blocks)))
        if not blocks:
            raise ProgramError(no_program("no-block"))
        findings = [lines.finding("3B101", damage.span, text=text[slice(*damage.span)]) for damage in damages]
        if not stops:
            findings.append(lines.finding("3B102", blocks[-1].span()))
        reading = Reading(
            dialect="tiny",
            counts=BlockCounts(len(blocks) + len(damages), len(blocks), len(blocks)),
            damages=tuple(damages),
            spelling=Spelling(clockwise="right", counter_clockwise="left", end="end", pause="pause"),
            is_drawing=False,
            not_asked={
                Check.BLOCKS: "reason-no-words",
                Check.PRINTED_ENDS: "reason-no-prints",
                Check.HEADER: "reason-no-header",
            },
        )
        toolpath = _toolpath(text, lines, blocks, tuple(labels), tuple(stops))
        return ReadText(lines, reading, {"words": 3.0}, toolpath, tuple(sorted(findings, key=file_order)))


def fields_of(block: str) -> Mapping[Field, Span]:
    match = _BLOCK.fullmatch(block)
    assert match is not None
    return {field: match.span(group) for group, field in _FIELDS.items() if match[group] is not None}


def _toolpath(
    text: str, lines: LineIndex, blocks: list[re.Match[str]], labels: tuple[str, ...], stops: tuple[Stop, ...]
) -> Toolpath:
    end = np.array([_places(block)[:2] for block in blocks])
    center = np.array([_places(block)[2:] for block in blocks])
    start = np.concatenate([np.zeros((1, 2)), end[:-1]])
    turn = np.array([{"left": 1.0, "right": -1.0, None: 0.0}[block[7]] for block in blocks])
    span = np.array([block.span() for block in blocks], dtype=np.int64)
    curves = curves_between(start, end, center, _sweep(start - center, end - center, turn))
    return Toolpath(
        **{name: getattr(curves, name) for name in type(curves).__slots__},
        printed_end_um=np.full((len(blocks), 2), np.nan),
        words=None,
        source=Source(text, np.arange(1, len(blocks) + 1), span, lines.lines(span[:, 0]), labels, fields_of),
        stops=stops,
    )


def _places(block: re.Match[str]) -> list[float]:
    """End and centre of a block in µm; the centre of a line is NaN."""
    numbers = [float(word) for word in block.groups()[:6] if word is not None]
    return [from_mm(number) for number in [*numbers, np.nan, np.nan][:4]]


def _sweep(start: Floats, end: Floats, turn: Floats) -> Floats:
    """Signed angles (n,) from places to others about a centre; a full turn where they are one, 0 on lines."""
    angle = np.arctan2(end[:, 1], end[:, 0]) - np.arctan2(start[:, 1], start[:, 0])
    turned = np.mod(angle * turn, 2.0 * np.pi)
    return np.where(turn == 0.0, 0.0, turn * np.where(turned < 1e-9, 2.0 * np.pi, turned))
