"""Counters of a control at any step: what the four beats have, and found again by them alone."""

import numpy as np
import pytest
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import program_text, programs

from controller.stepping.counters import counters_after, made_by
from controller.stepping.steps import interpolate, words_of
from parser.program import parse_program
from sim.teach.plain.blocks import Block, read_listing
from sim.teach.plain.stepping import begun, stepped


def plain_blocks(text: str) -> list[Block]:
    return read_listing(text).blocks


@settings(max_examples=examples(40))
@given(programs, st.integers(0, 10**9))
def test_counters_are_those_of_the_four_beats_at_each_step(program: list, seed: int) -> None:  # type: ignore[type-arg]
    """X, Y, F and J left of some steps of each block, by the plain stepper of lessons; and back from them."""
    text = program_text(program)
    toolpath = parse_program(text).toolpath
    steps, words = interpolate(toolpath), words_of(toolpath)
    for row, block in enumerate(plain_blocks(text)):
        total, stepper = int(steps.count[row]), begun(block)
        start, corner = stepper, steps.corner_um[row]
        looked_at = set(np.random.default_rng(seed + row).integers(0, total + 1, 6).tolist()) | {0, total}
        for made in range(min(total, 5_000) + 1):
            if made in looked_at:
                found = counters_after(steps, words, row, made)
                assert (found.x_um - corner[0], found.y_um - corner[1]) == (stepper.x - start.x, stepper.y - start.y)
                assert (found.deviation, found.count_left_um) == (stepper.deviation, stepper.count_left)
                assert made_by(steps, words, found) == made
            if made < total:
                stepper = stepped(block, stepper)


def test_counters_that_a_block_never_has_are_refused() -> None:
    toolpath = parse_program("B30B20B30GXL1 DD").toolpath
    steps, words = interpolate(toolpath), words_of(toolpath)
    found = counters_after(steps, words, 0, 7)
    with pytest.raises(ValueError, match="no step"):
        made_by(steps, words, found._replace(x_um=found.x_um + 9))
    with pytest.raises(ValueError, match="50 steps"):
        counters_after(steps, words, 0, 51)
