"""Plots and lists of curves that nobody would draw: instructions changed, moved, doubled, cut off."""

import random

from fuzzing.mutate import damaged, edited, number_text

_INSTRUCTIONS = (
    *("PU", "PD", "PA", "PR", "AA", "AR", "AT", "RT", "CI", "EA", "ER", "BZ", "BR", "PE", "SC", "IP", "LT", "SP", "PM"),
    *("EP", "FP", "WG", "LB", "DT", "IN", "DF", "RO", "XX", "p"),
)
_ROWS = ("line", "arc", "circle", "kind", "#", "spline", "")
_PLOT = "IN;SP1;PU0,0;PD800,0,800,400,0,400,0,0;PU200,200;CI80;PD500,120;AA660,200,180;PU;SP0;"
_LIST = "line,0,0,20,0\nline,20,0,20,10\narc,20,10,0,10,10,10,ccw\ncircle,5,5,2\n"


def fuzzed_plot(rng: random.Random) -> bytes:
    """A plot or a list."""
    text, mark, other = (_PLOT, ";", _instruction) if rng.random() < 0.7 else (_LIST, "\n", _row)
    parts = text.split(mark)
    for _ in range(rng.choice((0, 1, 1, 2, 4, 9))):
        parts = edited(rng, parts, lambda _: other(rng))
    data = mark.join(parts).encode("utf-8", "replace")
    return damaged(rng, data, [_PLOT.encode(), _LIST.encode()], (1, 2)) if rng.random() < 0.2 else data


def _instruction(rng: random.Random) -> str:
    name = rng.choice(_INSTRUCTIONS)
    if name == "PE":
        return name + "".join(chr(rng.choice((rng.randint(33, 254), rng.randint(63, 126)))) for _ in range(9))
    return name + ",".join(number_text(rng) for _ in range(rng.choice((0, 1, 2, 2, 3, 4, 6))))


def _row(rng: random.Random) -> str:
    return ",".join([rng.choice(_ROWS), *(number_text(rng) for _ in range(rng.choice((0, 3, 4, 6))))])
