"""The spellings of 3B and 4B as patterns over folded text (`parser.text.encoding.narrow`).

Spellings and their grades: docs/3b.md, sections 1, 2 and 6.
"""

import re
from functools import cache
from itertools import chain

from parser.dialect.choices import Marks

OWN_MARKS = Marks(end=("DD",), pause=("D",))
"""Marks of the dialect itself (docs/3b.md §2)."""
FOREIGN_ENDS = ("E", "FF", "MJ")
"""End marks of other controllers (docs/3b.md §2, recalled): read as the end, with a warning."""

# Possessive quantifiers keep hostile runs of blanks and digits linear. `WS` is blank space within a line.
WS = r"[ \t]*+"
_LINE_START = r"(?<![^\r\n])"
# `N7:`, `N7`, `7:`; a bare number only where a line begins with it: before a block, `7 DD`, `7DD`, but not `3D`.
_LINE_IS_DONE = rf"{WS}(?![^\r\n;/(])"
_BARE = rf"{_LINE_START}{WS}(\d++)(?:[ \t]++(?=B|DD?{_LINE_IS_DONE})|(?=DD{_LINE_IS_DONE}))"
LABEL = rf"(?:N{WS}(\d++){WS}:?{WS}|(?<![A-Z0-9])(\d++){WS}:{WS}|{_BARE})?"
_NUMBER = rf"B{WS}(\d*+){WS}"
_MM = rf"{WS}([-+]?(?:\d++(?:\.\d*+)?|\.\d++)){WS}"
_PRINTED = rf"{WS};{_MM},{_MM}(?![\d.])"
_CURVE = r"(DD?)"
# A 4B block has a fourth number, 0 or none for a line, and its curve mark behind that or behind the axis.
_RADIUS = rf"B{WS}(\d*+){WS}(?:{_CURVE}{WS})?"
BLOCK = (
    rf"({_NUMBER}{_NUMBER}{_NUMBER}(?:{_RADIUS})?"
    rf"G{WS}([XY]){WS}(?:{_CURVE}{WS})?(L|[SN]{WS}R){WS}([1-4])(?!\d))"
)
BLOCK_WORDS = ("B", "N", "L", "S", "G", "X", "Y", "GX", "GY", "NR", "SR")
"""Words of letters that stand in blocks and their labels, in parts and whole: as marks they would break blocks up."""
_START_NODE = rf"Start{WS}Point{WS}[=:]{WS}\(?{_MM},{_MM}[^\r\n]*"
_HEADER = r"(?:\*{2}|CAXA|Co(?:nn?|rn)er\s?R|Offset|Length)[^\r\n]*"
REMARK_SIGNS = "/(;"
"""First characters of remarks."""
_REMARK = r"//[^\r\n]*|;[^\r\n]*|\([^()\r\n]*\)"

FLAGS = re.IGNORECASE | re.ASCII
HIDDEN_BLOCK = re.compile(BLOCK, FLAGS)
# A line that was meant for a block: a number behind its first B or between two, a count axis with a machining code,
# or numbers with O or l among their digits.
_MISREAD = rf"B{WS}[0-9OIL]++{WS}"
LIKE_A_BLOCK = re.compile(
    rf"{_LINE_START}{WS}(?:N{WS}\d++{WS}:?{WS})?B{WS}\d|B{WS}\d*+{WS}B{WS}\d"
    rf"|G{WS}[XY]{WS}(?:DD?{WS})?(?:L|[NS]{WS}R){WS}\d"
    rf"|(?<![A-Z]){_MISREAD}{_MISREAD}(?:G|{_MISREAD})",
    FLAGS,
)

BLOCK_FIELDS = ("x", "y", "count", "radius", "mark_before", "axis", "mark_behind", "sense", "quadrant")
GROUPS = (
    *("label", "number", "bare_number", "block", *BLOCK_FIELDS, "end_x", "end_y"),
    *("mark", "node_x", "node_y", "passed"),
)
"""Groups of the token pattern, in its order."""

GROUP_AT = {name: place for place, name in enumerate(GROUPS)}
"""Places of the groups in `GROUPS`, from 0."""


@cache
def token_pattern(marks: Marks) -> re.Pattern[str]:
    """Pattern whose matches are the blocks, marks, start nodes, headers and remarks of a text."""
    known = {*chain(*OWN_MARKS, *marks), *FOREIGN_ENDS}
    words = sorted(known, key=lambda word: (-len(word), word))
    # A mark is a token: `D` in a word, in `part-D` or in `3D` is none; glued to a block or behind `N7` it is.
    mark = (
        rf"((?(1)|(?(3)|(?:(?<![A-Z0-9_-])|(?<=[LR][1-4]))))(?:{'|'.join(map(re.escape, words))}))"
        rf"(?:(?![A-Z0-9_-])|(?=B{WS}\d*+{WS}B))"
    )
    # Words behind a printed end are a remark up to the line end, unless a mark or a number is among them.
    no_mark = rf"(?![^\r\n\d]*(?<![A-Z0-9_-])(?:{'|'.join(map(re.escape, words))})(?![A-Z0-9_-]))"
    tail = rf"(?:{WS}{no_mark}[^\s\d;/()][^\r\n\d;/()]*+(?![^\r\n;/(]))?"
    printed = rf"(?:{_PRINTED}{tail})?"
    return re.compile(rf"{LABEL}(?:{BLOCK}{printed}|{mark}|{_START_NODE}|({_HEADER}|{_REMARK}))", FLAGS)
