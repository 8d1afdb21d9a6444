"""Plain 3B of lessons, held to the parser's reading and decoding, and to steps one by one."""

import itertools
import math
from pathlib import Path
from random import Random

import numpy as np
import pytest
from depth import cases
from plain import PlainBlock, plain_steps

from parser.findings.codes import Severity
from parser.program import parse_program
from parser.step_words.words import words_of_arcs, words_of_lines
from sim.check.file_check import check_program
from sim.check.settings import CheckSettings
from sim.teach.plain.blocks import Block, read_listing
from sim.teach.plain.curves import Point, decoded, distance_to, point_on
from sim.teach.plain.program import first_wrong
from sim.teach.plain.stepping import begun, next_way, stepped
from sim.teach.plain.tasks import SHAPES, seed_of, task_of

ROOT = Path(__file__).parents[3]
SENSES = {0: "L", 1: "NR", -1: "SR"}
HEAD = "****\nConner R= 0.00000 , Offset F= 0.10000 ,Length= 134.2 mm\nStart Point = 0.0 , 0.0\n"
PROGRAMS = cases(40, 2000)
BLOCKS = 500
WITHIN_UM = 1e-5
"""Places up to 10⁷ µm from the start, after 500 blocks."""


def text_of(block: Block) -> str:
    return f"B{block.x}B{block.y}B{block.count_um}G{'XY'[block.axis]}{SENSES[block.turn]}{block.quadrant}"


def random_block(chance: Random) -> Block:
    size = chance.choice((3, 50, 1000, 40_000))
    x, y = chance.choice((0, chance.randint(0, size))), chance.randint(0, size)
    count = chance.choice((0, max(x, y), chance.randint(0, 5 * size)))
    return Block(x, y, count, chance.randint(0, 1), chance.choice((0, 1, -1)), chance.randint(1, 4), 1)


@pytest.mark.deep
@pytest.mark.parametrize("seed", PROGRAMS)
def test_blocks_end_where_those_of_the_parser_do(seed: int) -> None:
    chance = Random(seed)
    text = "\n".join(text_of(random_block(chance)) for _ in range(BLOCKS)) + "\nDD\n"
    path = parse_program(text, "part.3b").toolpath

    curves = decoded(read_listing(text).blocks, Point(0.0, 0.0))

    ends = np.array([(curve.end.x, curve.end.y) for curve in curves])
    assert np.abs(ends - path.end_um).max() < WITHIN_UM
    sweeps = np.array([curve.sweep_rad for curve in curves])
    assert np.abs(sweeps - path.sweep_rad).max() < 1e-6


def spelled(chance: Random, block: Block) -> str:
    """A block as people and CAM write it."""
    blank = chance.choice(("", "", " ", "\t", "  "))
    zeros = chance.choice(("", "", "0"))
    numbers = [f"{zeros}{value}" if value or chance.random() < 0.7 else "" for value in block[:3]]
    sense = SENSES[block.turn]
    if len(sense) == 2 and chance.random() < 0.2:
        sense = f"{sense[0]}{blank}{sense[1]}"
    words = [*(f"B{blank}{number}" for number in numbers), f"G{blank}{'XY'[block.axis]}", f"{sense}{block.quadrant}"]
    text = chance.choice(("", "", "N7:", "N 7 :", "12: ", "N3 ")) + blank.join(words)
    text += chance.choice(("", "", ";0.000,24.900//end", " // a remark", " (remark)", ";-1.5,2"))
    if chance.random() < 0.2:
        text = text.lower()
    if chance.random() < 0.1:
        text = "".join(chr(ord(letter) + 0xFEE0) if letter.isalnum() else letter for letter in text)
    return text


@pytest.mark.parametrize("seed", range(60))
def test_spellings_are_read_as_the_parser_reads_them(seed: int) -> None:
    chance = Random(seed)
    wanted = [random_block(chance) for _ in range(30)]
    head = chance.choice(
        ("", "****\nConner R= 0.00000 , Offset F= 0.10000 ,Length= 134.2 mm\nStart Point = 0.0 , 0.0\n")
    )
    text = head + chance.choice(("\n", "\r\n")).join(spelled(chance, block) for block in wanted) + "\nN9: DD//the end\n"

    listing = read_listing(text)
    path = parse_program(text, "part.3b").toolpath

    assert [block._replace(line=1) for block in listing.blocks] == wanted
    assert (listing.unread, listing.marks[-1].is_end) == ([], True)
    assert len(path) == len(wanted)
    assert [block.line for block in listing.blocks] == path.source.line.tolist()


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("B1000B0B1000GXL5", 1, 1),
        ("B1000B0B1000GZL1", 1, 1),
        ("B10O0B0B1000GXL1", 1, 1),
        ("B1000B0B1000GXL1\nhello", 2, 1),
        ("B1000B0B1000GXL1 B", 1, 18),
        ("B123456789B0B1GXL1", 1, 1),
        ("B1B1B1GXNL1", 1, 1),
        ("DDD", 1, 1),
    ],
)
def test_what_is_no_block_is_told_by_its_place(text: str, line: int, column: int) -> None:
    assert read_listing(text).unread == [(line, column)]


def test_nothing_is_read_behind_the_end() -> None:
    listing = read_listing("B1B0B1GXL1 D\nDD\n\n; a remark\nB2B0B2GXL1\n")

    assert (len(listing.blocks), listing.behind_end) == (1, 1)
    assert [mark.is_end for mark in listing.marks] == [False, True]


@pytest.mark.parametrize("seed", cases(150, 2000))
def test_steps_are_those_of_the_four_beats(seed: int) -> None:
    chance = Random(seed)
    block = random_block(chance)._replace(count_um=chance.randint(1, 3000))
    if block.turn and block.x**2 + block.y**2 <= 1:
        block = block._replace(x=7)
    if not block.turn and not block[block.axis]:
        block = block._replace(x=3, y=5)
    plain = PlainBlock(block.x, block.y, block.count_um, "XY"[block.axis], SENSES[block.turn], block.quadrant)

    stepper, ways = begun(block), []
    while stepper.count_left > 0:
        ways.append(next_way(block, stepper))
        stepper = stepped(block, stepper)

    assert np.cumsum(ways, axis=0).tolist() == [list(place) for place in plain_steps(plain)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("name", [f"pupil {number}" for number in range(40)])
def test_the_block_of_a_task_is_the_one_that_the_trade_writes(shape: str, name: str) -> None:
    task = task_of(shape, seed_of(name))
    start, end = (np.array([place], dtype=np.float64) for place in (task.start, task.end))
    if task.block.turn:
        centre = np.array([task.centre], dtype=np.float64)
        curve = decoded([task.block], task.start)[0]
        words = words_of_arcs(start - centre, end - centre, np.array([curve.sweep_rad]))
    else:
        words = words_of_lines(end - start)
    expected = (words.x_um, words.y_um, words.count_um, words.count_axis, words.quadrant, words.turn)
    x, y, count, axis, quadrant, turn = (int(column[0]) for column in expected)

    assert task.block == (x, y, count, axis, turn, quadrant, 1)
    assert math.dist(decoded([task.block], task.start)[0].end, task.end) < 1e-6
    result = check_program(parse_program(text_of(task.block) + "\nDD\n", "part.3b"), CheckSettings())
    assert not [found for found in result.findings if found.severity is Severity.ERROR and found.code < "3B3"]


def test_seeds_give_many_tasks() -> None:
    tasks = {task_of(shape, seed_of(f"{number}")).block for shape in SHAPES for number in range(100)}

    assert len(tasks) > 0.95 * 600 - 100  # of circles there are 19 sizes with 8 beginnings


@pytest.mark.parametrize("seed", range(50))
def test_distances_to_curves_are_those_to_many_places_on_them(seed: int) -> None:
    chance = Random(seed)
    curve = decoded([random_block(chance)], Point(0.0, 0.0))[0]
    place = Point(chance.uniform(-1e5, 1e5), chance.uniform(-1e5, 1e5))
    places = [point_on(curve, number / 20_000) for number in range(20_001)]
    nearest = min(math.dist(place, other) for other in places)
    length = sum(itertools.starmap(math.dist, itertools.pairwise(places)))

    assert distance_to(curve, place) <= nearest + 1e-6
    assert distance_to(curve, place) > nearest - length / 20_000 - 1e-6


WRONG = {"3B201", "3B202", "3B203", "3B204", "3B205", "3B208", "3B210"}


@pytest.mark.parametrize("seed", range(100))
def test_words_against_the_rules_are_those_that_a_check_finds(seed: int) -> None:
    chance = Random(seed)
    task = task_of(chance.choice(SHAPES), seed_of(f"{seed}"))
    block = task.block
    change = chance.choice(("none", "axis", "count", "quadrant"))
    if change == "axis" and block.x != block.y:
        block = block._replace(axis=1 - block.axis)
    if change == "count" and not block.turn:
        block = block._replace(count_um=block.count_um - 77)
    if change == "quadrant" and 0 in {block.x, block.y}:
        block = block._replace(quadrant=block.quadrant % 4 + 1)
    result = check_program(parse_program(text_of(block) + "\nDD\n", "part.3b"), CheckSettings())
    found = {finding.code for finding in result.findings} & WRONG

    is_wrong = first_wrong([block], decoded([block], task.start)) == 1

    if not block.turn:  # an arc that counts on the other axis ends elsewhere, where that axis may be right
        assert is_wrong == (block != task.block)
    assert is_wrong or not found
    if is_wrong and not found:  # steps of an arc on the other axis end near enough: the rule of the trade is the finer
        assert (change, block.turn != 0) == ("axis", True)


@pytest.mark.parametrize("scenario", ["keyhole", "round-hole", "narrow-neck", "punch", "die", "backlash"])
def test_sound_programs_go_by_the_rules(scenario: str) -> None:
    text = (ROOT / "scenarios" / scenario / "program.3b").read_text("utf-8")
    listing = read_listing(text)
    blocks = listing.blocks

    assert (first_wrong(blocks, decoded(blocks, Point(0.0, 0.0))), listing.unread) == (0, [])
    assert len(blocks) == len(parse_program(text, "part.3b").toolpath)
