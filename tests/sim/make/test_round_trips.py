"""Round trips over sound programs: 3B to ISO and back word for word but for what is allowed; ISO in every dialect."""

import random
from collections import Counter
from typing import NamedTuple

import numpy as np
import pytest
import sound
from depth import cases

from parser.controller_words import StepWords
from parser.geometry.curves import Bools
from parser.program import Program, dialects, load_program
from parser.toolpath import Toolpath
from parser.write.iso import iso_choices
from sim.make.convert import Converted, converted
from sim.make.wanted import Wanted

_TIE_UM = 2.5
_MOST_OTHER = 0.03


def conversion(program: Program, wanted: Wanted) -> Converted:
    done = converted(program, wanted)
    assert isinstance(done, Converted), done
    return done


def in_dialect(program: Program, dialect: str) -> Converted:
    return conversion(program, Wanted("iso", iso_choices(dialect), keeps=True))


class Compared(NamedTuple):
    """Rows of which words differ: the rule cannot tell the axis, J by rounding, ways by rounding, anything else."""

    tie: Bools
    count: Bools
    way: Bools
    other: Bools


def compared(before: Toolpath, after: Toolpath) -> Compared:
    """Words of a program beside those that come back; lines that were reduced may come back in full."""
    one, other = before.words, after.words
    assert one is not None
    assert other is not None
    reduced = (one.turn == 0) & (np.maximum(one.x_um, one.y_um) != one.count_um)
    differs = {name: getattr(one, name) != getattr(other, name) for name in StepWords.__slots__}
    out = np.abs(before.end_um - before.center_um)
    tie = before.is_arc & differs["count_axis"] & (np.abs(out[:, 0] - out[:, 1]) < _TIE_UM)
    ways = np.maximum(np.abs(one.x_um - other.x_um), np.abs(one.y_um - other.y_um))
    counts = np.abs(one.count_um - other.count_um)
    sense = differs["turn"] | differs["quadrant"]
    near = np.hypot(*(before.end_um - after.end_um).T) < 3.0
    way = ~tie & ~reduced & ((ways > 0) | differs["count_axis"]) & ~sense & near
    return Compared(tie, ~tie & ~way & (counts == 1) & (ways == 0), way, (sense & ~tie) | ~near | ~reduced & (ways > 2))


@pytest.mark.deeper
def test_3b_comes_back_from_iso_word_for_word_but_for_rounding() -> None:
    rng = random.Random(1)
    rows: Counter[str] = Counter()
    for number in cases(16, 40):
        program = load_program(sound.sound_program(rng).data, "part.3b")
        iso = in_dialect(program, dialects()[number % len(dialects())])
        back = conversion(iso.program, Wanted("3b")).program
        assert len(back.toolpath) == len(program.toolpath)
        found = compared(program.toolpath, back.toolpath)
        rows["all"] += len(program.toolpath)
        for name, which in found._asdict().items():
            rows[name] += int(which.sum())
    assert rows["all"] >= 25 * len(cases(16, 40))
    assert rows["other"] <= 0.002 * rows["all"]  # arcs of two or three µm
    assert rows["count"] + rows["way"] <= _MOST_OTHER * rows["all"]
    assert rows["tie"] <= _MOST_OTHER * rows["all"]


@pytest.mark.deeper
@pytest.mark.parametrize("seed", cases(1, 4))
def test_iso_has_the_same_path_in_every_dialect(seed: int) -> None:
    program = load_program(sound.sound_program(random.Random(100 + seed)).data, "part.3b")
    first = in_dialect(program, "fast-wire").program
    for dialect in dialects():
        there = in_dialect(first, dialect)
        again = in_dialect(there.program, "fast-wire")
        assert there.off_um <= 1.0
        rapid = len(there.program.toolpath) - len(first.toolpath)  # to the start, where no G92 names it
        is_elsewhere = bool(first.toolpath.start_um[0].any())
        assert rapid == (is_elsewhere and iso_choices(dialect).habits.starts_by == "rapid")
        np.testing.assert_allclose(there.program.toolpath.end_um[rapid:], first.toolpath.end_um, atol=1.0)
        np.testing.assert_allclose(there.program.toolpath.length_um[rapid:], first.toolpath.length_um, atol=2.0)
        np.testing.assert_allclose(again.program.toolpath.end_um[rapid:], first.toolpath.end_um, atol=1.0)
        assert rapid or again.data == in_dialect(first, "fast-wire").data


def test_a_file_is_the_same_when_it_is_written_again() -> None:
    program = load_program(sound.sound_program(random.Random(7)).data, "part.3b")
    for wanted in (Wanted("3b"), Wanted("3b", form="aligned"), Wanted("3b", form="detailed")):
        once = conversion(program, wanted)
        assert conversion(once.program, wanted).data.splitlines()[-20:] == once.data.splitlines()[-20:]
