"""The way of decoded blocks: where each ends on the path of the wire, by hand; blocks that run often, or never."""

import json
import random

import pytest
from jsonschema import Draft202012Validator
from places import ROOT

from controller.decode.blocks import Decoded, decoded
from controller.decode.document import document_text
from parser.dialect.reader import Choices
from parser.findings.errors import ProgramError
from parser.program import parse_program
from sim.show.decoded import way_texts

VALIDATOR = Draft202012Validator(json.loads((ROOT / "docs" / "decode.schema.json").read_text(encoding="utf-8")))
SOUND = """\
N10 G92 X0 Y0
H001=110
N20 G90 G41 H1 G01 X5000 Y0 F20 ;
N30 G03 X5000 Y0 I-5000 J0 (round)
N40 M98 P1
N50 G40 X0 Y0
M02
N1 G91 G01 X10 Y10
M99
"""


def ways(*lines: str, d_um: float = 1000.0) -> dict[int, Decoded]:
    """Decoded blocks by their lines, of a program in mm."""
    choices = Choices(dialect="classroom", registers=(("D1", d_um),))
    program = parse_program("\n".join(["G92 X0 Y-5", "G90", *lines, "M02"]), "part.iso", choices=choices)
    return {one.block.line: one for one in decoded(program, program.toolpath)}


def centers(*lines: str, d_um: float = 1000.0) -> list[tuple[float, float] | None]:
    """Where the blocks that move end on the path of the wire's centre."""
    return [one.way.wire_center_um for one in ways(*lines, d_um=d_um).values() if one.way is not None]


def test_a_shortened_block_ends_where_the_offsets_meet() -> None:
    set_up, first, last, cancel = centers("G41 D1 G01 X0 Y0", "X10", "Y10", "G40 X20")

    assert set_up == pytest.approx((0.0, 1000.0))
    assert first == pytest.approx((9000.0, 1000.0))
    assert last == pytest.approx((9000.0, 10000.0))
    assert cancel == pytest.approx((20000.0, 10000.0))


def test_a_lengthened_block_reaches_out_to_where_the_offsets_meet() -> None:
    assert centers("G42 D1 G01 X0 Y0", "X10", "Y10", "G40 X20")[1] == pytest.approx((11000.0, -1000.0))


def test_a_block_that_has_no_place_on_the_path_says_so() -> None:
    told = ways("G41 D1 G01 X0 Y0", "X10", "X10.4 Y0.4", "Y10", "G40 X20")

    assert told[5].way is not None
    assert told[5].way.wire_center_um is None
    assert told[5].way.left_um is not None


def test_the_centre_of_an_arc_and_where_the_wire_ends_are_told_apart() -> None:
    arc = ways("G41 D1 G01 X0 Y0", "G03 X10 Y10 I0 J10", "G40 G01 X20")[4].way

    assert arc is not None
    assert arc.arc_center_um == pytest.approx((0.0, 10_000.0))
    assert arc.wire_center_um == pytest.approx((9_000.0, 10_000.0))
    line = ways("G01 X0 Y0")[3].way
    assert line is not None
    assert line.arc_center_um is None


def test_without_compensation_there_is_the_contour_alone() -> None:
    way = ways("G01 X0 Y0")[3].way

    assert way is not None
    assert (way.kind, way.length_um, way.end_um) == ("line", 5000.0, (0.0, 0.0))
    assert (way.left_um, way.right_um, way.wire_center_um, way.joint, way.before_line) == (None, None, None, "none", 0)


def test_a_register_without_value_leaves_the_ends_open_and_names_itself() -> None:
    one = ways("G41 D2 G01 X0 Y0", "X10")[4]

    assert one.way is not None
    assert one.way.left_um is None
    assert one.block.in_force is not None
    assert (one.block.in_force.register, one.block.in_force.offset_um) == ("D2", None)


def test_a_block_of_a_subprogram_is_shown_once_with_how_often_it_runs() -> None:
    told = ways("G91", "M98 P9", "M98 P9", "M02", "N9 G01 X1", "M99")

    assert told[7].way is not None
    assert (told[7].way.runs, told[7].way.end_um) == (2, (1000.0, -5000.0))


def test_a_block_behind_the_end_is_decoded_and_has_no_way() -> None:
    told = ways("M02", "G01 X7")

    assert told[4].way is None
    assert told[4].block.coor_um == {"X": 7000.0}


def test_a_program_in_3b_has_no_decoded_blocks() -> None:
    program = parse_program("B1000 B0 B1000 GX L1\nDD\n")

    assert decoded(program, program.toolpath) == ()


@pytest.mark.alike(20)
@pytest.mark.parametrize("seed", range(60))
def test_a_damaged_program_is_decoded_to_what_the_schema_allows(seed: int) -> None:
    rng = random.Random(seed)
    text = list(SOUND)
    for _ in range(rng.randrange(1, 8)):
        at = rng.randrange(len(text))
        text[at : at + rng.randrange(3)] = rng.choice(
            ["G41", "9" * 400, "-", ".", "N", "\n", ";", "(", "M98 P1", "G20", "", "Ｘ"]
        )
    try:
        program = parse_program("".join(text), "part.iso")
    except ProgramError:
        return
    blocks = decoded(program, program.toolpath)

    VALIDATOR.validate(json.loads(document_text(program, blocks, "en")))
    assert [step.order for one in blocks for step in one.block.steps[-1:]] == [len(one.block.steps) for one in blocks]
    assert all(way.text.zh for one in blocks for way in way_texts(one))
