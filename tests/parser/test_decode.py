"""Exact decoding: closed forms against a walk from extreme to extreme, and the published numbers."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from places import SCENARIOS
from plain import SIGNS, PlainBlock, plain_arc_end
from strategies import arcs, lines, program_text, programs

from parser.geometry.curves import CurveKind
from parser.program import parse_program, read_program
from parser.toolpath import Toolpath


def decode(*blocks: PlainBlock) -> Toolpath:
    return parse_program(program_text(list(blocks))).toolpath


def test_keyhole_decodes_to_the_printed_numbers() -> None:
    toolpath = read_program(SCENARIOS / "keyhole" / "program.3b").toolpath
    assert toolpath.end_um[3] == pytest.approx([56756.009, 24898.279], abs=0.001)  # µm, the paper's exact end
    assert math.hypot(*toolpath.end_um[-1]) == pytest.approx(0.28, abs=0.005)  # µm
    block = toolpath.block(3)
    assert block.kind is CurveKind.ARC
    assert block.is_major
    assert block.center_um == (100000.0, 0.0)
    assert block.radius_um == math.sqrt(43243**2 + 24900**2)
    assert block.sweep_rad is not None
    assert block.sweep_rad > math.pi
    assert block.label == "N4"
    assert block.text == "B 43243 B 24900 B 149800 GY NR3"
    assert block.printed_end_um == pytest.approx((56756.0, 24898.0))
    assert [(stop.kind, stop.after) for stop in toolpath.stops] == [("end", 6)]


def test_printed_ends_agree_with_the_decoding_to_their_last_digit() -> None:
    toolpath = read_program(SCENARIOS / "keyhole" / "program.3b").toolpath
    assert np.abs(toolpath.printed_end_um - toolpath.end_um).max() < 0.51  # µm, printed to 1 µm


@given(lines())
def test_line_ends_where_its_count_ends(block: PlainBlock) -> None:
    toolpath = decode(block)
    counted, other = (block.x, block.y) if block.axis == "X" else (block.y, block.x)
    along, across = block.count, block.count * other / counted
    by = (along, across) if block.axis == "X" else (across, along)
    expected = [sign * way for sign, way in zip(SIGNS[block.quadrant], by, strict=True)]
    assert toolpath.end_um[0] == pytest.approx(expected, rel=1e-14, abs=1e-9)
    assert toolpath.length_um[0] == pytest.approx(math.hypot(*by))


@given(arcs(longest_turns=6))
def test_arc_ends_where_counting_from_extreme_to_extreme_ends(block: PlainBlock) -> None:
    toolpath = decode(block)
    # At an extreme the end moves by sqrt(2 R δ) for a rounding of δ, so its tolerance is wider than that of the walk.
    assert toolpath.end_um[0] == pytest.approx(plain_arc_end(block), abs=1e-4)


@given(arcs(longest_turns=6))
def test_arc_columns_agree_with_one_another(block: PlainBlock) -> None:
    toolpath = decode(block)
    radius, sweep = toolpath.radius_um[0], toolpath.sweep_rad[0]
    assert radius == math.sqrt(block.x**2 + block.y**2)
    assert np.sign(sweep) == (1 if block.sense == "NR" else -1)
    assert toolpath.length_um[0] == pytest.approx(radius * abs(sweep))
    for angle, place in (
        (toolpath.start_angle_rad[0], toolpath.start_um[0]),
        (toolpath.end_angle_rad[0], toolpath.end_um[0]),
    ):
        on_circle = toolpath.center_um[0] + radius * np.array([math.cos(angle), math.sin(angle)])
        assert place == pytest.approx(on_circle, abs=1e-4)
    assert bool(toolpath.is_major[0]) == (abs(sweep) > math.pi)
    assert abs(sweep) == pytest.approx(2 * math.pi * block.count / (4 * radius), abs=2 * math.pi)


@pytest.mark.parametrize("turns", [1, 2, 7])
@pytest.mark.parametrize("axis", ["X", "Y"])
@pytest.mark.parametrize(("sense", "sign"), [("NR", 1), ("SR", -1)])
def test_full_turns_from_an_axis_close_exactly(turns: int, axis: str, sense: str, sign: int) -> None:
    toolpath = decode(PlainBlock(9900, 0, 39600 * turns, axis, sense, 1))
    assert toolpath.end_um[0].tolist() == [0.0, 0.0]
    assert toolpath.sweep_rad[0] == pytest.approx(sign * turns * 2 * math.pi, rel=1e-15)


@given(programs)
def test_each_block_starts_where_the_last_one_ended(program: list) -> None:
    toolpath = decode(*program)
    assert np.array_equal(toolpath.start_um[1:], toolpath.end_um[:-1])
    alone = np.array([decode(block).end_um[0] for block in program])
    assert toolpath.end_um[-1] == pytest.approx(alone.sum(axis=0), abs=1e-6)


@given(st.integers(1, 4), st.integers(1, 10**6))
def test_line_without_x_and_y_runs_along_the_axis_of_its_label(quadrant: int, count: int) -> None:
    axis = "X" if quadrant in (1, 3) else "Y"
    toolpath = parse_program(f"BBB{count}G{axis}L{quadrant}").toolpath
    expected = {1: (count, 0), 2: (0, count), 3: (-count, 0), 4: (0, -count)}[quadrant]
    assert tuple(toolpath.end_um[0] + 0.0) == expected


@pytest.mark.parametrize("text", ["B1B0B100000GXNR1", "B0B1B100000GYSR1", "B0B5B100GXL1"])
def test_a_block_that_never_ends_makes_no_move(text: str) -> None:
    toolpath = parse_program(f"{text}\nDD").toolpath
    assert (toolpath.end_um.tolist(), toolpath.length_um.tolist()) == ([[0.0, 0.0]], [0.0])


def test_reduced_line_takes_its_length_from_the_count() -> None:
    toolpath = parse_program("B1B9B90000GYL4").toolpath
    assert toolpath.end_um[0].tolist() == [10000.0, -90000.0]


def test_a_toolpath_cannot_be_changed_nor_made_of_uneven_columns() -> None:
    toolpath = decode(PlainBlock(3, 4, 4, "Y", "L", 1))
    with pytest.raises(ValueError, match="read-only"):
        toolpath.end_um[0] = 0.0
    with pytest.raises(ValueError, match="one length"):
        replace(toolpath, length_um=np.zeros(2))


def test_long_words_lose_nothing_to_rounding() -> None:
    toolpath = parse_program("B999999937B999999929B999999937GXL1").toolpath
    assert toolpath.end_um[0].tolist() == [999999937.0, 999999929.0]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("B0B0B10GXNR1", "3B201"),
        ("B1B0B10GXNR1", "3B201"),
        ("B0B5B5GXL2", "3B202"),
        ("BBB5GYL1", "3B202"),
        ("B5B5B0GXL1", "3B205"),
        ("B5B0B5GXL1;0.005,0.003", "3B213"),
        ("B5B0B5GXL1;0.005,0.005", "3B207"),
        ("B5B0B5GXL1 DD B5B0B5GXL1", "3B103"),
    ],
)
def test_faulty_blocks_are_named_and_keep_their_row(text: str, code: str) -> None:
    program = parse_program(f"B1B0B1GXL1\n{text}\nDD")
    assert [finding.code for finding in program.findings] == [code]
    assert len(program.toolpath) == 2


def test_a_damaged_printed_end_is_named_once() -> None:
    blocks = "".join(f"B100B0B100GXL1;{0.1 * n + (0.05 if n > 2 else 0):.3f},0.000\n" for n in range(1, 6))
    findings = parse_program(blocks + "DD").findings
    assert [(finding.code, finding.block) for finding in findings] == [("3B207", 3)]
