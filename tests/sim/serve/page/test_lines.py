"""Lines that changed: what is told makes the later text of the earlier one, and takes no longer than one waits."""

import random
import time

import pytest

from sim.serve.page.app import changed_lines


def made(before: str, told: dict) -> str:
    """The later text, from the earlier one and the places, from the top, each at its line of the later text."""
    lines = before.split("\n")
    for place in told["places"]:
        was, now = place["lines"]
        at = place["line"] - 1
        assert lines[at : at + was] == (place["before"].split("\n") if was else [])
        lines[at : at + was] = place["after"].split("\n") if now else []
    return "\n".join(lines)


@pytest.mark.parametrize("seed", range(40))
def test_the_places_make_the_later_text_of_the_earlier_one(seed: int) -> None:
    chance = random.Random(seed)
    before = [f"B{chance.randrange(5)}" for _ in range(chance.randrange(1, 40))]
    after = list(before)
    for _ in range(chance.randrange(6)):
        at = chance.randrange(len(after) + 1)
        after[at : at + chance.randrange(3)] = [f"C{number}" for number in range(chance.randrange(3))]
    old, new = "\n".join(before), "\n".join(after)
    told = changed_lines(old, new)
    assert told["more"] == 0
    assert made(old, told) == new
    assert (told["places"] == []) == (old == new)


def test_one_line_among_equal_ones_is_one_place() -> None:
    square = ["B9B0B9GXL1", "B0B9B9GYL2", "B9B0B9GXL3", "B0B9B9GYL4"] * 10_000
    after = [*square[:20_001], "B0B8B8GYL2", *square[20_002:]]
    told = changed_lines("\n".join(square), "\n".join(after))
    assert told == {
        "places": [{"line": 20_002, "before": "B0B9B9GYL2", "after": "B0B8B8GYL2", "lines": [1, 1]}],
        "more": 0,
    }


def test_texts_that_share_nothing_are_told_short_and_soon() -> None:
    begun = time.process_time()
    before, after = ("\n".join(f"{letter}{number}" for number in range(50_000)) for letter in "ab")
    (place,) = changed_lines(before, after)["places"]
    assert place["lines"] == [50_000, 50_000]
    assert len(place["after"].split("\n")) == 40
    many = "\n".join(f"{'a' if number % 2 else 'b'}{number}" for number in range(1000))
    told = changed_lines("\n".join(f"a{number}" for number in range(1000)), many)
    assert (len(told["places"]), told["more"]) == (100, 400)
    assert time.process_time() - begun < 3.0
