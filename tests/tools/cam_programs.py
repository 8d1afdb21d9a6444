"""Sound programs as a CAM writes them: figures with jumps between them, one block a line."""

import random
from typing import NamedTuple

import numpy as np
from broken import built, decoded
from drawings import Line, contour
from plain import PlainBlock

from parser.shape.passes import find_passes
from parser.threeb.decode import decode
from parser.threeb.reader import read_records
from parser.toolpath import Toolpath
from sim.check.crossings import find_crossings


class Row(NamedTuple):
    """A line of a program: a block of figure `figure`, −1 for a jump; or a mark where `block` is None."""

    block: PlainBlock | None
    mark: str
    figure: int
    label: str
    printed: str

    @property
    def text(self) -> str:
        return f"{self.label}{self.block.text() if self.block else self.mark}{self.printed}"


class Sound(NamedTuple):
    """A sound program; whether it prints the end of every block."""

    rows: list[Row]
    printed: bool

    @property
    def text(self) -> str:
        return "\n".join(row.text for row in self.rows) + "\n"


def sound_program(rng: random.Random, *, printed: bool) -> Sound:
    """One to three closed figures."""
    rows: list[Row] = []
    figures = rng.choice((1, 1, 2, 3))
    for figure in range(figures):
        if figure:
            way = built([Line((round(rng.uniform(2e5, 3e5)), round(rng.uniform(-2e4, 2e4))))])[0]
            rows += [Row(None, "D", -1, "", ""), Row(way, "", -1, "", ""), Row(None, "D", -1, "", "")]
        rows += [Row(block, "", figure, "", "") for block in _figure(rng)]
    rows.append(Row(None, "DD", -1, "", ""))
    return Sound(_with_ends(rows) if printed else rows, printed)


def _figure(rng: random.Random) -> list[PlainBlock]:
    """A closed figure; drawings of which a lead-in crosses the contour are made anew."""
    while True:
        blocks = built(contour(rng)[1])
        path = decoded(blocks)
        if not find_crossings(path, np.zeros(len(blocks), dtype=np.int64), find_passes(path)):
            return blocks


def decoded_text(text: str) -> Toolpath:
    """Path of a text, up to its end code; of any text, whatever is wrong with it."""
    records = read_records(text)
    end = next((mark.after for mark in records.marks if mark.kind == "end"), len(records.blocks.line))
    blocks = type(records.blocks)._make(column[:end] for column in records.blocks)
    return decode(records._replace(blocks=blocks, marks=tuple(m for m in records.marks if m.after <= end)))


def _with_ends(rows: list[Row]) -> list[Row]:
    """Rows with labels and with the ends of the blocks in mm, as the Qt paper prints them."""
    ends = iter((decoded([row.block for row in rows if row.block]).end_um / 1000.0).tolist())
    labelled = []
    for number, row in enumerate(rows, start=1):
        printed = "; {:.3f} , {:.3f}".format(*next(ends)) if row.block else ""
        labelled.append(row._replace(label=f"N{number}: ", printed=printed))
    return labelled
