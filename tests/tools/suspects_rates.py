"""How often `parser.threeb.mend.suspects` finds a broken block: ``PYTHONPATH=. python tests/tools/suspects_rates.py``.

Sound closed contours as a CAM writes them are broken in one field of one block at random. The table says, for each
field, in how many of those that no longer close the broken block is named, named first, and named alone; how often with
the very value that stood there; and how many are named on the average.
"""

import argparse
import random
from collections import Counter, defaultdict

from broken import broken, built, decoded
from drawings import contour

from parser.threeb.mend.suspects import suspects


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--contours", type=int, default=3000)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--verbose", action="store_true")
    asked = options.parse_args()
    rng = random.Random(asked.seed)
    tally: dict[str, Counter[str]] = defaultdict(Counter)
    for _ in range(asked.contours):
        kind, moves = contour(rng)
        sound = built(moves)
        damage = broken(rng, sound)
        toolpath = decoded(damage.program)
        if damage.closes:
            continue
        named = suspects(toolpath, 0, len(toolpath))
        rows = [s.row for s in named]
        exact = (damage.row, damage.field, damage.was) in [(s.row, s.field, s.other) for s in named]
        for key in (damage.field, damage.kind, f"~{kind}", "all"):
            tally[key].update(
                open=1,
                found=damage.row in rows,
                first=rows[:1] == [damage.row],
                only=rows == [damage.row],
                value=exact,
                none=not rows,
                wrong=bool(rows) and damage.row not in rows,
                named=len(rows),
            )
        if asked.verbose and (rows != [damage.row] or not exact):
            print(kind, damage.row, damage.kind, damage.was, "->", damage.program[damage.row].text(), named)
            print("    ", "  ".join(block.text() for block in damage.program))
    print(f"{'broken':24}{'open':>6}{'found':>8}{'only':>8}{'value':>8}{'wrong':>8}{'none':>8}{'named':>8}")
    for kind, n in sorted(tally.items()):
        shares = "".join(f"{n[key] / n['open']:8.1%}" for key in ("found", "only", "value", "wrong", "none"))
        print(f"{kind:24}{n['open']:6}{shares}{n['named'] / n['open']:8.2f}")


if __name__ == "__main__":
    main()
