"""Target `read`: programs of all dialects, read and nothing more, so that more are tried than can be checked.

Its promises follow from the text and from plain geometry: what is found has a place in the text, rows go on where
the row before them ends, and every figure is finite.
"""

import math
import random
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import numpy as np

from fuzzing.iso_text import fuzzed_iso
from fuzzing.pmac_text import fuzzed_pmac
from fuzzing.program_text import fuzzed_program
from fuzzing.promises import of_place, of_texts
from fuzzing.target import Input, Judged
from parser.dialect.reader import UNITS, Choices, Marks
from parser.findings.codes import Severity
from parser.findings.errors import ProgramError
from parser.geometry.curves import CurveKind
from parser.program import Program, dialects, load_program
from parser.text.encoding import encode_text

_MAKES = (*[fuzzed_program] * 7, fuzzed_iso, fuzzed_pmac, fuzzed_pmac)
_CHOICES = (
    *[Choices()] * 12,
    *(Choices(unit=unit) for unit in UNITS),
    *(Choices(dialect=dialect) for dialect in dialects()),
    Choices(marks=Marks(end=("B",), pause=("N",))),
    Choices(registers=(("D0", 100.0), ("D1", -3.5), ("H1", 1e6))),
)
_NAMES = ("fuzz.3b", "fuzz.3b", "fuzz.iso", "fuzz.pmc", "O0013")
_AGAIN = 8  # of one in so many the texts are written, and it is read again from UTF-8
_ROUNDING = 1e-6
"""Share of the largest coordinate by which a figure may differ: sums of blocks lose some digits."""

_ROUNDED_UM = 1.5
"""Half of what both ends of an arc in whole µm may differ in their way from its centre: 2 √2 µm, ISO212."""


def make(rng: random.Random) -> Input:
    """A program of any dialect."""
    return rng.choice(_MAKES)(rng)


def judge(data: Input, number: int, _: Path) -> Judged:
    """The promises of reading; `number` picks what is told of the program besides its text."""
    assert isinstance(data, bytes)
    choices, name = _CHOICES[number % len(_CHOICES)], _NAMES[number % len(_NAMES)]
    try:
        program = load_program(data, name, choices)
    except ProgramError as error:
        found = (error.finding, *error.others)
        return Judged(repr(found), list(chain.from_iterable(map(of_texts, found))), "refused")
    broken = [*_of_text(program, data), *_of_rows(program), *_of_curves(program)]
    broken += chain.from_iterable(of_place(one, program.lines) for one in program.findings)
    if number % _AGAIN == 0:
        broken += _of_encoding(program, name)
        broken += chain.from_iterable(of_texts(one) for one in program.findings)
    return Judged(
        repr((program.findings, program.toolpath.end_um.tobytes())), broken, program.reading.dialect.split()[0]
    )


def _of_text(program: Program, data: bytes) -> Iterator[str]:
    """The text is written back to the bytes that were read."""
    if encode_text(program.text, program.encoding) != data:
        yield f"{program.encoding} is not written back as it was"


def _of_rows(program: Program) -> Iterator[str]:
    """Each row is written in the text, and rows go on where the one before ends."""
    path, source = program.toolpath, program.toolpath.source
    if not len(path):
        return
    if not np.array_equal(path.start_um[1:], path.end_um[:-1]):
        yield "a row starts elsewhere than the row before it ends"
    first, past = source.span[:, 0], source.span[:, 1]
    if (first < 0).any() or (past < first).any() or (past > len(program.text)).any():
        yield "a block is written beyond the text"
    elif not np.array_equal(source.line, program.lines.lines(first)):
        yield "a block names another line than that on which it is written"
    if any(not 0 <= stop.after <= len(path) for stop in path.stops):
        yield "a stop lies beyond the path"


def _of_curves(program: Program) -> Iterator[str]:
    """Figures are finite, and lengths are those of lines and arcs by their ends, centre and sweep."""
    path = program.toolpath
    if not len(path):
        return
    ends, arc = np.concatenate([path.start_um, path.end_um]), path.kind == CurveKind.ARC
    if not np.isfinite(ends).all() or not np.isfinite(path.length_um).all() or (path.length_um < 0.0).any():
        yield "ends or lengths are not finite"
        return
    chord = np.array([math.dist(*pair) for pair in zip(path.start_um, path.end_um, strict=True)])
    around = np.concatenate([path.center_um[arc].ravel(), path.radius_um[arc], path.sweep_rad[arc]])
    if not np.isfinite(around).all():
        yield "centre, radius or sweep of an arc is not finite"
        return
    length = np.where(arc, np.abs(path.sweep_rad) * np.where(arc, path.radius_um, 0.0), chord)
    loss = _ROUNDING * (1.0 + max(np.abs(ends).max(), np.abs(around).max(initial=0.0)))
    if (np.abs(length - path.length_um) > loss).any():
        yield "a length is not that of its line or arc"
    if (path.sweep_rad[~arc] != 0.0).any():
        yield "a line turns"
    for end_um in (path.start_um[arc], path.end_um[arc]):
        away = np.hypot(*(end_um - path.center_um[arc]).T)
        off = (np.abs(away - path.radius_um[arc]) > max(loss, _ROUNDED_UM)).any()
        if off and not any(finding.severity is not Severity.NOTE for finding in program.findings):
            yield "an arc ends off its circle without a word"


def _of_encoding(program: Program, name: str) -> Iterator[str]:
    """The same text in UTF-8 is the same program."""
    try:
        data = program.text.encode()
    except UnicodeEncodeError:
        return
    again = load_program(data, name, program.choices)
    if again.encoding.startswith("utf-8") and again.text == program.text:
        same = np.array_equal(again.toolpath.end_um, program.toolpath.end_um) and again.findings == program.findings
        if not same:
            yield "reads otherwise in UTF-8"
