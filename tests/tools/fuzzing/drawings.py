"""Target `dxf`: drawings read. Target `compare`: drawings that a cut is held against."""

import random
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np
from places import SCENARIOS

from fuzzing.dxf_text import fuzzed_dxf
from fuzzing.plot_text import fuzzed_plot
from fuzzing.promises import of_document, unclean
from fuzzing.target import Input, Judged
from parser.drawing.model import Drawing
from parser.drawing.read import read_drawing
from parser.findings.catalogue import LANGUAGES, remark_text
from parser.findings.errors import DrycutError
from parser.program import Program, read_program
from sim.measure.compare.compare import compare_program
from sim.measure.compare.result import FitRequest
from sim.run.report.drawing import document_text

_LAYERS = (None, None, None, "CUT", "0", "nowhere", "\x1b[2J")
_FLATTEN_UM = (1.0, 0.01, 1000.0)


def make(rng: random.Random) -> Input:
    """A drawing; one in five is a plot or a list of curves."""
    return fuzzed_plot(rng) if rng.random() < 0.2 else fuzzed_dxf(rng)


def judge(data: Input, number: int, folder: Path) -> Judged:
    """A drawing is refused in a line, or read to curves whose numbers can be worked with."""
    found = _read(data, number, folder)
    if isinstance(found, str):
        return Judged(found, [] if found.strip() else ["refused without a word"], "refused")
    return Judged(repr(found.curves) + repr(found.notes), list(_of_drawing(found)), "read")


def judge_compared(data: Input, number: int, folder: Path) -> Judged:
    """A drawing that can be read is compared, or refused in a line."""
    found = _read(data, number, folder)
    if isinstance(found, str):
        return Judged(found, [], "refused")
    asked = FitRequest(5.0, number % 2 == 0, "fail" if number % 3 else "tell")
    try:
        done = compare_program(_program().toolpath, 100.0, found, asked)
    except DrycutError as error:
        return Judged(str(error), [] if str(error).strip() else ["refused without a word"], "not compared")
    text = document_text(done)
    return Judged(text, [*of_document("json", text)], "compared")


def _read(data: Input, number: int, folder: Path) -> Drawing | str:
    """The drawing, or the words by which it was refused."""
    assert isinstance(data, bytes)
    file = folder / "fuzz.dxf"
    file.write_bytes(data)
    try:
        return read_drawing(
            file, layer=_LAYERS[number % len(_LAYERS)], flatten_um=_FLATTEN_UM[number % len(_FLATTEN_UM)]
        )
    except DrycutError as error:
        return str(error).replace(str(folder), "HERE")


def _of_drawing(found: Drawing) -> Iterator[str]:
    curves = found.curves
    columns = dict.fromkeys(("start_um", "end_um", "sweep_rad", "length_um"), slice(None))
    columns |= dict.fromkeys(("center_um", "radius_um", "start_angle_rad"), curves.is_arc)
    for name, rows in columns.items():
        if not np.isfinite(getattr(curves, name)[rows]).all():
            yield f"{name} that is not finite"
    if len(found.entity) != len(curves) or not (found.entity < len(found.entities)).all():
        yield "curves of no entity"
    for note in found.notes:
        for language in LANGUAGES:
            yield from (f"note: {what}" for what in unclean(remark_text(note, language)))


@cache
def _program() -> Program:
    return read_program(SCENARIOS / "round-hole" / "program.3b")
