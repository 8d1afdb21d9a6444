"""Random programs of ISO that say everything in every way: modes, scales, threadings, calls, registers, bad arcs."""

import math
from random import Random

_HEADS = ("G92 X{x} Y{y}", "G92", "G92 X{x}", "")
_MODES = ("G90", "G91", "G90.1", "G91.1", "G40", "G41", "G42", "G41 D1", "G42 H2", "D3", "G04 X5", "G20", "G21")


def random_iso(seed: int, blocks: int = 40) -> str:
    """One program, its lines ended by LF."""
    random = Random(seed)
    lines = [f"{letter}{number} = {random.randint(50, 200)}" for letter, number in (("D", 1), ("H", 2), ("D", 3))]
    lines.append(_filled(random, random.choice(_HEADS)))
    lines += [_line(random, calls=(1, 2)) for _ in range(blocks)]
    lines.append("M02")
    lines += ["N0001", *(_line(random, calls=(2,)) for _ in range(blocks // 4)), "M99"]
    lines += ["N0002", *(_line(random, calls=()) for _ in range(blocks // 4)), "M99"]
    return "\n".join(lines) + "\n"


def _line(random: Random, calls: tuple[int, ...]) -> str:
    kind = random.random()
    if kind < 0.2:
        return random.choice(_MODES)
    if kind < 0.24:
        return random.choice(["M00", "M01", "M21", "M00", "(remark)"])
    if kind < 0.30:
        return _filled(random, random.choice(_HEADS[:3]))
    if kind < 0.33:
        return random.choice(["D1 = 110", "H002 = .1 + D1", "D03 = H2 + D1 + 7", "H2 =-50"])
    if kind < 0.37 and calls:
        return f"M98 P{random.choice(calls):04}" + random.choice(["", " L2", " L3"])
    return _move(random)


def _move(random: Random) -> str:
    head = random.choice(["", "", f"N{random.randint(1, 99) * 10} "]) + random.choice(["", "", "G41 ", "G40 ", "G91 "])
    word = random.choice(["G00 ", "G01 ", "G01 ", "", "G02 ", "G03 "])
    end = random.choice(["X{x} Y{y}", "X{x}", "Y{y}", "X{x}Y{y}", ""])
    if word in {"G02 ", "G03 "} or random.random() < 0.2:
        end += " " + random.choice(["I{x} J{y}", "I{x}", "J{y}", "R{r}", "R-{r}", "I0 J0"])
    if word == "G03 " and random.random() < 0.5:
        return _true_arc(random)
    return _filled(random, head + word + end)


def _true_arc(random: Random) -> str:
    """An arc whose ends are rounded from one circle, in a block that is a way from its start."""
    radius, start, sweep = random.uniform(50, 20_000), random.uniform(0, math.tau), random.uniform(0.02, math.tau)
    by = [radius * (turn(start + sweep) - turn(start)) for turn in (math.cos, math.sin)]
    center = [-radius * turn(start) for turn in (math.cos, math.sin)]
    return "G91 G91.1 G03 X{:.0f} Y{:.0f} I{:.0f} J{:.0f}".format(*by, *center)


def _filled(random: Random, form: str) -> str:
    return form.format(x=_number(random), y=_number(random), r=_number(random).lstrip("-"))


def _number(random: Random) -> str:
    um = random.randint(-20_000, 20_000)
    return random.choice([str(um), f"{um / 1000:.3f}", f"{um / 10:.0f}", str(um // 1000 * 1000), "0"])
