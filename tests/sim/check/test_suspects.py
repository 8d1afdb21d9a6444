"""Suspects: the damaged block of a contour that does not close."""

import random
import re

import pytest
from broken import broken, built, decoded, gap_um
from drawings import contour
from hypothesis import given
from hypothesis import strategies as st
from plain import PlainBlock

from parser.dialect.mender import Suspect
from parser.threeb.decode import decode
from parser.threeb.mend.suspects import MOST, suspects
from parser.threeb.reader import read_records

KEYHOLE = (
    "B0B24900B24900GYL2 B0B24900B49800GXNR2 B56757B0B56757GXL1 "
    "B43243B24900B149800GYNR3 B56756B2B56756GXL2 B0B24900B24900GYL4"
)
SQUARE = "B10000B0B10000GXL1 B0B10000B10000GYL2 B10000B0B10000GXL3 B0B10000B10000GYL4"
ROUNDED = (
    "B2000B0B2000GXL1 B20000B0B20000GXL1 B0B3000B3000GYNR4 B0B14000B14000GYL2 B3000B0B3000GXNR1 "
    "B20000B0B20000GXL3 B0B3000B3000GYNR2 B0B14000B14000GYL4 B3000B0B3000GXNR3"
)
ARROW = "B12000B5000B12000GXL1 B3000B9000B9000GYL1 B15000B4950B15000GXL3 B0B9050B9050GYL4"


def of(text: str) -> tuple[Suspect, ...]:
    toolpath = decode(read_records(text))
    return suspects(toolpath, 0, len(toolpath))


@pytest.mark.parametrize(
    ("sound", "row", "bad", "suspect"),
    [
        (KEYHOLE, 4, "B56756B2B56756GXL1", ("sense", "L1", "L2")),
        (KEYHOLE, 3, "B43243B24900B149800GYL3", ("sense", "L3", "NR3")),
        (KEYHOLE, 1, "B0B24900B49800GYNR2", ("axis", "GY", "GX")),
        (KEYHOLE, 2, "B56757B0B56757GYL1", ("axis", "GY", "GX")),
        (KEYHOLE, 3, "B43243B24900B14980GYNR3", ("count", "14980", "149800")),
        (KEYHOLE, 3, "B43243B34900B149800GYNR3", ("y", "34900", "24900")),
        (KEYHOLE, 3, "B23243B24900B149800GYNR3", ("x", "23243", "43243")),
        (ROUNDED, 4, "B3000B0B2000GXNR1", ("count", "2000", "3000")),
        (ROUNDED, 3, "B0B14000B19000GYL2", ("count", "19000", "14000")),
        (ROUNDED, 5, "B20000B500B20000GXL3", ("y", "500", "0")),
        (ROUNDED, 4, "B5000B0B3000GXNR1", ("x", "5000", "3000")),
        (ARROW, 0, "B12000B5900B12000GXL1", ("y", "5900", "5000")),
        (ARROW, 0, "B18000B5000B12000GXL1", ("x", "18000", "12000")),
        (ARROW, 1, "B8000B9000B9000GYL1", ("x", "8000", "3000")),
    ],
)
def test_the_broken_block_is_named_with_what_stood_there(
    sound: str, row: int, bad: str, suspect: tuple[str, str, str]
) -> None:
    blocks = sound.split()
    assert of(" ".join([*blocks[:row], bad, *blocks[row + 1 :]])) == (Suspect(row, *suspect),)


def test_a_line_without_x_and_y_turns_with_its_label() -> None:
    bare = re.sub(r"B\d+B\d+(B\d+G.L)", r"BB\1", SQUARE)
    assert Suspect(2, "sense", "L4", "L3") in of(bare.replace("GXL3", "GXL4"))


def test_a_lead_in_that_is_not_cut_back_is_told_from_the_loop_that_closes() -> None:
    named = of(f"B2000B1000B2000GXL1 {SQUARE} B2000B1000B2000GXL4")
    assert {(s.row, s.field) for s in named} == {(0, "sense"), (5, "sense")}


def test_rows_outside_the_contour_are_left_alone() -> None:
    broken_square = SQUARE.replace("B10000GXL3", "B19000GXL3")
    toolpath = decode(read_records(f"B7000B0B7000GXL1 {broken_square} B0B7000B7000GYL2"))
    assert suspects(toolpath, 1, 5) == (Suspect(3, "count", "19000", "10000"),)


@pytest.mark.parametrize(
    "text",
    [
        "B10000B0B10000GXL1 B0B10000B10000GYL2 B4000B3100B4000GXL3",  # a side is missing
        " ".join([SQUARE.replace("B10000GXL3", "B9123GXL3"), "B1234B777B1234GXL1"]),  # two faults
        "B10000B0B10000GXL1",
    ],
)
def test_nobody_is_accused_where_no_one_mend_will_do(text: str) -> None:
    assert of(text) == ()


def test_nobody_is_accused_where_too_many_are_as_likely() -> None:
    teeth = [PlainBlock(9000, 0, 9000, "X", "L", 1), PlainBlock(0, 8000, 8000, "Y", "L", 2)] * 4
    teeth += [PlainBlock(9000, 0, 9000, "X", "L", 3), PlainBlock(0, 8000, 8000, "Y", "L", 4)] * 4
    toolpath = decoded([*teeth[:5], PlainBlock(0, 8000, 8000, "Y", "L", 4), *teeth[6:]])
    assert len(suspects(toolpath, 0, len(toolpath))) <= MOST


@given(st.integers(0, 10**9))
def test_a_mend_closes_the_contour(seed: int) -> None:
    rng = random.Random(seed)
    damage = broken(rng, built(contour(rng)[1]))
    toolpath = decoded(damage.program)
    for suspect in suspects(toolpath, 0, len(toolpath)):
        block = damage.program[suspect.row]
        if suspect.field == "sense":
            mended = block._replace(sense=suspect.other[:-1], quadrant=int(suspect.other[-1]))
        elif suspect.field == "axis":
            mended = block._replace(axis=suspect.other[1])
        else:
            mended = PlainBlock(**(block._asdict() | {suspect.field: int(suspect.other)}))
        program = [*damage.program[: suspect.row], mended, *damage.program[suspect.row + 1 :]]
        assert gap_um(decoded(program)) <= 5.0


def test_nearly_every_broken_block_is_found() -> None:
    rng = random.Random(20260101)
    damages = [broken(rng, built(contour(rng)[1])) for _ in range(200)]
    opened = [damage for damage in damages if not damage.closes]
    named = [[s.row for s in suspects(decoded(d.program), 0, len(d.program))] for d in opened]
    assert sum(d.row in rows for d, rows in zip(opened, named, strict=True)) >= 0.95 * len(opened)
    assert sum(rows == [d.row] for d, rows in zip(opened, named, strict=True)) >= 0.88 * len(opened)
