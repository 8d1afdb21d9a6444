"""Array steps against plain ones on random programs: ``PYTHONPATH=. python tests/tools/long_steps.py``.

Every program is made from the seed and its own number, so that one that differs is made again by its number.
"""

import argparse
import math
import random
import sys
import time

import numpy as np
from chunked import chunks_of
from plain import PlainBlock, plain_steps
from strategies import program_text

from controller.stepping.steps import interpolate
from parser.program import parse_program

SEED = 20260101
_LONGEST = 200_000  # steps of a block, about
_LARGEST = 800_000_000  # µm, radius


def random_program(seed: int, number: int) -> list[PlainBlock]:
    """Some lines and arcs of all sizes, in all quadrants, counted on either axis."""
    rng = random.Random(f"{seed}:{number}")
    return [_line(rng) if rng.random() < 0.4 else _arc(rng) for _ in range(rng.randint(1, 8))]


def difference(program: list[PlainBlock], size: int) -> tuple[int, str]:
    """Number of steps, and how the array steps, worked out `size` at a time, differ from the plain ones."""
    at, walks = np.zeros(2, dtype=np.int64), []
    for block in program:
        walks.append(at + np.array(plain_steps(block)))
        at = walks[-1][-1]
    expected, row = np.concatenate(walks), np.repeat(np.arange(len(program)), [len(walk) for walk in walks])
    steps = interpolate(parse_program(program_text(program)).toolpath)
    if len(steps) != len(expected):
        return len(expected), f"{len(steps)} steps, not {len(expected)}"
    chunks = list(chunks_of(steps, size))
    made = np.stack([np.concatenate([c.x_um for c in chunks]), np.concatenate([c.y_um for c in chunks])], axis=1)
    wrong = np.flatnonzero((made != expected).any(axis=1) | (np.concatenate([c.row for c in chunks]) != row))
    if len(wrong):
        first = wrong[0]
        return len(
            expected
        ), f"step {first + 1}: {made[first].tolist()}, not {expected[first].tolist()} in row {row[first]}"
    return len(expected), ""


def run(most: int, seed: int) -> tuple[int, list[str]]:
    """Steps compared, at least `most`, and what differed in which program."""
    done, number, wrong = 0, 0, []
    shown, began = 0, time.perf_counter()
    while done < most:
        size = random.Random(f"{seed}:{number}:size").choice([997, 1 << 14, 1 << 18])
        steps, differs = difference(random_program(seed, number), size)
        wrong += [f"program {number}: {differs}"] if differs else []
        done, number = done + steps, number + 1
        if done >= shown + most // 10:
            shown = done
            print(f"{number:,} programs, {done:,} steps, {len(wrong)} differ, {time.perf_counter() - began:.0f} s")
    return done, wrong


def _line(rng: random.Random) -> PlainBlock:
    x, y = _size(rng, 10**6), rng.choice([_size(rng, 10**6), 0, 1])
    x, y = (x, y) if rng.random() < 0.5 else (y, x)
    x, y = (x, x or 1) if rng.random() < 0.1 else (x, y)
    axis = rng.choice([name for name, extent in (("X", x), ("Y", y)) if extent])
    most = _LONGEST * (x if axis == "X" else y) // (x + y)
    return PlainBlock(x, y, _size(rng, max(1, most)), axis, "L", rng.randint(1, 4))


def _arc(rng: random.Random) -> PlainBlock:
    """An arc from a point of its circle, the axes included, of up to three turns."""
    largest = rng.choice([30, 10**4, 10**6, _LARGEST])
    x, y = rng.choice([(_size(rng, largest), _size(rng, largest)), (_size(rng, largest) + 1, 0)])
    x, y = (x + 1, y) if rng.random() < 0.5 else (y, x + 1)
    radius = math.hypot(x, y)
    # Beside an extreme of the counted axis a count of c takes sqrt(2 R c) steps on the other.
    most = int(min(12.0 * radius, _LONGEST, _LONGEST**2 / (2.0 * radius)))
    count = rng.choice([rng.randint(1, most), _size(rng, most)])
    return PlainBlock(x, y, count, rng.choice("XY"), rng.choice(["NR", "SR"]), rng.randint(1, 4))


def _size(rng: random.Random, largest: int) -> int:
    """From 1 to the largest, small ones as often as large ones."""
    return round(largest ** rng.random())


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--steps", type=int, default=10**8)
    options.add_argument("--seed", type=int, default=SEED)
    asked = options.parse_args()
    done, wrong = run(asked.steps, asked.seed)
    print("\n".join(wrong) or f"{done:,} steps, all the same")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
