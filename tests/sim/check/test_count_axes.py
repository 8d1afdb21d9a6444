"""Count axes: the rule, what J is on either axis, and what a wrong one costs, against walks of one µm at a time."""

import math
import random

import numpy as np
import pytest
from plain import PlainBlock, plain_steps

from controller.stepping.steps import interpolate
from parser.findings.findings import Finding
from parser.program import parse_program
from sim.check.closures import (
    count_on,
    ruled_count_axis,
    stepped_end_findings,
    stepped_miss,
)


def found(text: str) -> list[Finding]:
    program = parse_program(f"{text} DD")
    return stepped_end_findings(program, interpolate(program.toolpath))


def random_block(rng: random.Random) -> PlainBlock:
    x, y = rng.randint(1, 400), rng.randint(1, 400)
    sense = rng.choice(("L", "NR", "SR"))
    longest = max(x, y) if sense == "L" else rng.randint(1, 3 * math.isqrt(x * x + y * y))
    return PlainBlock(x, y, longest, rng.choice("XY"), sense, rng.randint(1, 4))


def test_blocks_miss_their_end_by_what_the_plain_walk_misses_it() -> None:
    rng = random.Random(1)
    blocks = [random_block(rng) for _ in range(120)]
    toolpath = parse_program("\n".join([*(block.text() for block in blocks), "DD"])).toolpath
    by = toolpath.end_um - toolpath.start_um
    walked = np.array([plain_steps(block)[-1] for block in blocks])
    assert stepped_miss(toolpath, interpolate(toolpath)) == pytest.approx(np.hypot(*(walked - by).T), abs=1e-6)


def test_j_on_either_axis_is_the_way_that_a_fine_walk_makes_on_it() -> None:
    rng = random.Random(2)
    blocks = [random_block(rng)._replace(x=rng.randint(900, 4000), y=rng.randint(900, 4000)) for _ in range(60)]
    blocks = [block._replace(count=max(block.x, block.y)) if block.sense == "L" else block for block in blocks]
    toolpath = parse_program("\n".join([*(block.text() for block in blocks), "DD"])).toolpath
    for axis in (0, 1):
        counts = count_on(toolpath, np.arange(len(blocks)), np.full(len(blocks), axis))
        for row, block in enumerate(blocks):
            if block.sense == "L":
                way = abs(toolpath.end_um[row] - toolpath.start_um[row])[axis]
            else:
                angle = toolpath.start_angle_rad[row] + np.linspace(0.0, toolpath.sweep_rad[row], 20001)
                places = toolpath.radius_um[row] * (np.cos(angle) if axis == 0 else np.sin(angle))
                way = np.abs(np.diff(places)).sum()
            assert counts[row] == pytest.approx(way, abs=0.51)


@pytest.mark.parametrize(
    ("block", "axis"),
    [
        ("B100B99B100GXL1", 0),
        ("B99B100B100GYL1", 1),
        ("B3000B4000B3000GXNR1", 0),  # to 0, 5000: on the Y axis
        ("B4000B3000B3000GYSR1", 1),  # to 5000, 0: on the X axis
        ("B4000B3000B990GYNR1", 0),  # to 3000, 4000 and beyond 45°
        ("B5000B0B3500GYNR1", 1),  # to 3571, 3500: not quite 45°
    ],
)
def test_lines_count_on_their_longer_side_and_arcs_by_where_they_end(block: str, axis: int) -> None:
    toolpath = parse_program(f"{block} DD").toolpath
    assert ruled_count_axis(toolpath).tolist() == [axis]


@pytest.mark.parametrize(
    ("block", "cost"),
    [
        ("B1100B500B500GYL1", None),  # ends 2 µm short: what the rounding of two sides may be
        ("B1500B500B500GYL1", None),
        ("B2000B500B500GYL1", 3.0),
        ("B2000B500B2000GXL1", None),
        ("B505B500B500GYL1", None),
    ],
)
def test_a_wrong_axis_is_named_from_3_um_on(block: str, cost: float | None) -> None:
    told = [(f.code, f.block, f.values["cost"], f.values["axis"], f.values["ruled"]) for f in found(block)]
    assert told == ([] if cost is None else [("3B204", 1, cost, "Y", "X")])


def test_a_wrong_axis_is_told_with_the_count_that_ends_the_block_where_it_ends() -> None:
    (line,) = found("B2000B500B500GYL1")
    assert (line.values["count"], line.values["right"]) == (2000, 0.0)
    (arc,) = found("B9900B0B39600GXNR1")
    assert (arc.values["count"], arc.values["right"], arc.values["cost"]) == (39600, 0.0, 140.0)
    # J is that of the other axis: a slip of the letter alone keeps it.
    (slip,) = found("B2000B500B2000GYL1")
    assert slip.values["count"] == 2000


def test_beside_a_wrong_count_no_axis_is_named() -> None:
    assert found("B2000B500B700GYL1") == []


@pytest.mark.parametrize(("block", "is_named"), [("B6B1B1GYL1", False), ("B7B1B1GYL1", True)])
def test_where_two_sides_differ_by_5_um_at_most_either_axis_will_do(block: str, *, is_named: bool) -> None:
    assert [finding.code for finding in found(block)] == ["3B204"] * is_named


def test_a_print_beside_a_wrong_axis_does_not_hide_it() -> None:
    assert [finding.code for finding in found("B2000B500B500GYL1;2.500,0.500\n")] == ["3B204"]
