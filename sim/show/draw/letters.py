"""How wide a text is in the shipped font, by the widths and the kerning that stand beside it: no font is loaded."""

import json
from functools import cache
from itertools import pairwise
from typing import Final, NamedTuple

from sim.show.draw import style

METRICS: Final = style.FONT.with_name("metrics.json")
"""Of the font, in its own units; `tests/tools/font_metrics.py` writes them."""


class _Metrics(NamedTuple):
    """Widths of letters, and how far pairs are moved, in parts of a size; what has no advance here is `usual` wide."""

    usual: float
    advances: dict[str, float]
    kerning: dict[tuple[str, str], float]


def text_width(text: str, size: float) -> float:
    """Width of a line of text, in the unit of its size (the em): the sum of its advances, and of its kerning.

    That is the width at any size; in pixels a font rounds each letter, which makes up to one part in a hundred.
    """
    metrics = _metrics()
    advances = sum(metrics.advances.get(letter, metrics.usual) for letter in text)
    return size * (advances + sum(metrics.kerning.get(pair, 0.0) for pair in pairwise(text)))


@cache
def _metrics() -> _Metrics:
    stored = json.loads(METRICS.read_text("utf-8"))
    em = stored["units_per_em"]
    return _Metrics(
        stored["usual"] / em,
        {letter: width / em for letter, width in stored["advances"].items()},
        {(left, right): by / em for left, row in stored["kerning"].items() for right, by in row.items()},
    )
