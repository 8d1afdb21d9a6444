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


_SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="30mm" viewBox="0 0 50 30"> <g id="a" '
    'transform="translate(5,5) rotate(30)"> <rect x="0" y="0" width="40" height="20" rx="2"/> <circle cx="5" cy="5" '
    'r="2"/> <path d="M10 10 A 3 2 30 0 1 15 10 L 12 13 Z"/> <path d="M20 10 Q 25 15 30 10 C 32 6 22 4 20 10"/> </g> '
    '<use href="#a" x="3"/> <text x="3" y="3">a</text> <polyline points="0,0 3,3 4,1" stroke-dasharray="1 2"/> </svg>'
)


def fuzzed_plot(rng: random.Random) -> bytes:
    """A plot, an SVG or a list."""
    text, mark, other = rng.choice(
        ((_PLOT, ";", _instruction), (_PLOT, ";", _instruction), (_LIST, "\n", _row), (_SVG, " ", _word))
    )
    parts = text.split(mark)
    for _ in range(rng.choice((0, 1, 1, 2, 4, 9))):
        parts = edited(rng, parts, lambda _: other(rng))
    data = mark.join(parts).encode("utf-8", "replace")
    seeds = [text.encode() for text in (_PLOT, _LIST, _SVG)]
    return damaged(rng, data, seeds, (1, 2)) if rng.random() < 0.2 else data


def _word(rng: random.Random) -> str:
    name = rng.choice(
        ("<g>", "</g>", "<path", "/>", "d=", "transform=", "width=", "viewBox=", "rx=", "style=", "A", "z")
    )
    numbers = " ".join(number_text(rng) for _ in range(rng.choice((0, 1, 2, 4, 7))))
    return f'{name}"{numbers}"' if name.endswith("=") else f"{name} {numbers}"


def _instruction(rng: random.Random) -> str:
    name = rng.choice(_INSTRUCTIONS)
    if name == "PE":
        return name + "".join(chr(rng.choice((rng.randint(33, 254), rng.randint(63, 126)))) for _ in range(9))
    return name + ",".join(number_text(rng) for _ in range(rng.choice((0, 1, 2, 2, 3, 4, 6))))


def _row(rng: random.Random) -> str:
    return ",".join([rng.choice(_ROWS), *(number_text(rng) for _ in range(rng.choice((0, 3, 4, 6))))])
