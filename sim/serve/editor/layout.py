"""The layout of a program: the words of its blocks in columns, or a blank between them; nothing else moves.

What is laid out is read again: where it says anything else than before, all of it stays as it was.
"""

import re
from collections import Counter
from typing import Final

import numpy as np

from parser.findings.errors import ProgramError
from parser.findings.findings import Edit, edited
from parser.program import Program, load_program
from parser.text.encoding import narrow
from parser.toolpath import Toolpath

_BLOCK_3B: Final = re.compile(r"B(\d*)B(\d*)B(\d*)(?:B(\d*))?(G[XY]D{0,2})([LSN]R?[1-4])", re.IGNORECASE)
_REMARK_ISO: Final = re.compile(r"(\([^()\r\n]*\))")
_WORD_ISO: Final = re.compile(r"[A-Z]\s*[-+]?(?:\d+\.?\d*|\.\d+)", re.IGNORECASE)


def layout_of(program: Program) -> tuple[Edit, ...]:
    """What is to be changed; nothing where all stands so, or blocks would be read otherwise."""
    path, decoder = program.toolpath, program.decoder
    found = (block.span for block in decoder.blocks()) if decoder else map(tuple, path.source.span.tolist())
    spans = sorted(set(found))
    texts = [program.text[first:past] for first, past in spans]
    laid = _laid_3b(texts) if path.words is not None else [_laid_iso(text) for text in texts]
    edits = tuple(
        Edit(first, past, new) for (first, past), old, new in zip(spans, texts, laid, strict=True) if new != old
    )
    return edits if edits and _is_the_same(program, edits) else ()


def _laid_3b(texts: list[str]) -> list[str]:
    """Blocks with their numbers in columns as wide as the longest; what is no block by itself stays."""
    found = [_BLOCK_3B.fullmatch(re.sub(r"\s", "", narrow(text))) for text in texts]
    numbers = [number for match in found if match for number in match.groups()[:4] if number is not None]
    width = max(map(len, numbers), default=0)
    return [_in_columns(match, width) if match else text for match, text in zip(found, texts, strict=True)]


def _in_columns(block: re.Match[str], width: int) -> str:
    *numbers, axis, label = block.groups()
    columns = [f"B {number:>{width}}" for number in numbers if number is not None]
    return " ".join([*columns, axis.upper(), label.upper()])


def _laid_iso(text: str) -> str:
    """Words and remarks apart from each other by a blank, where there is nothing else."""
    laid: list[str] = []
    for at, piece in enumerate(_REMARK_ISO.split(text)):
        plain = narrow(piece)
        if at % 2:
            laid.append(piece)
        elif _WORD_ISO.sub("", plain).strip():
            return text
        else:
            laid += [re.sub(r"\s", "", word).upper() for word in _WORD_ISO.findall(plain)]
    return " ".join(laid) if laid else text


def _is_the_same(program: Program, edits: tuple[Edit, ...]) -> bool:
    """Whether the program says the same with the edits made, and nothing more is wrong with it."""
    try:
        other = load_program(edited(program.text, edits).encode("utf-8"), program.name, program.choices)
    except ProgramError:
        return False
    before, after = (Counter(finding.code for finding in one.findings) for one in (program, other))
    return not after - before and _are_alike(program.toolpath, other.toolpath)


def _are_alike(one: Toolpath, other: Toolpath) -> bool:
    columns = ("kind", "start_um", "end_um", "center_um", "sweep_rad", "printed_end_um")
    pairs = ((getattr(one, name), getattr(other, name)) for name in columns)
    if len(one) != len(other) or not all(np.array_equal(a, b, equal_nan=True) for a, b in pairs):
        return False
    if (one.words is None) != (other.words is None):
        return False
    told = ("x_um", "y_um", "count_um", "count_axis", "quadrant", "turn", "radius_um", "curve")
    words = one.words, other.words
    return words[0] is None or all(np.array_equal(getattr(words[0], name), getattr(words[1], name)) for name in told)
