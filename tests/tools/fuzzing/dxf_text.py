"""DXF that nobody would draw: pairs of group code and value changed, moved, doubled, cut off and thrown together."""

import random
import struct
from functools import cache
from typing import NamedTuple

from places import SCENARIOS

from fuzzing.mutate import TEXTS, damaged, edited, number_text

_BINARY = b"AutoCAD Binary DXF\r\n\x1a\x00"
_KINDS = ("LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "VERTEX", "SEQEND", "ELLIPSE", "SPLINE", "INSERT", "POINT")
_OTHERS = ("TEXT", "MTEXT", "HATCH", "SOLID", "3DFACE", "DIMENSION", "ATTRIB", "VIEWPORT", "XLINE", "LEADER", "ACAD_X")
_CLASSES = {"LWPOLYLINE": "AcDbPolyline", "SPLINE": "AcDbSpline", "ELLIPSE": "AcDbEllipse", "MTEXT": "AcDbMText"}
_MARKS = ("SECTION", "ENDSEC", "EOF", "BLOCK", "ENDBLK", "TABLE", "ENDTAB", "LAYER", "ENTITIES", "BLOCKS", "TABLES")
_CODES = (
    *(0, 1, 2, 3, 5, 6, 8, 9, 10, 20, 30, 11, 21, 31, 12, 13, 38, 39, 40, 41, 42, 43, 44, 45, 50, 51, 62, 66, 67, 70),
    *(71, 72, 73, 74, 90, 91, 100, 102, 210, 220, 230, 290, 310, 330, 360, 370, 999, 1000, 1001, 1010, 1071, -1, 10**9),
)
_LAYERS = ("0", "CUT", "cut", "HIDDEN", "加工", "\x1b[2J")
_VERSIONS = ("AC1009", *["AC1015"] * 4, "AC1012", "AC1015", "AC1024", "AC1032", "AC1006", "AC9999", "")


class Pair(NamedTuple):
    """A group: its code and its value, as they stand in the file."""

    code: str
    value: str


def fuzzed_dxf(rng: random.Random) -> bytes:
    """One drawing."""
    pairs = drawing(rng) if rng.random() < 0.7 else list(rng.choice(_seeds()))
    for _ in range(rng.choice((0, 1, 1, 2, 4))):
        pairs = edited(rng, pairs, lambda pair: _other(rng, pair))
    data = _binary(pairs) if rng.random() < 0.1 else _text(rng, pairs)
    return damaged(rng, data, [_text(rng, seed) for seed in _seeds()], (1, 2)) if rng.random() < 0.1 else data


@cache
def _seeds() -> tuple[tuple[Pair, ...], ...]:
    files = sorted(SCENARIOS.glob("*/drawing.dxf"))
    lines = [file.read_text(encoding="utf-8").splitlines() for file in files]
    return tuple(tuple(map(Pair, of[::2], of[1::2])) for of in lines)


def _other(rng: random.Random, pair: Pair) -> Pair:
    if rng.random() < 0.15:
        return pair._replace(code=str(rng.choice(_CODES)) if rng.random() < 0.8 else rng.choice(TEXTS))
    if pair.code.strip() == "0":
        return pair._replace(value=rng.choice((*_KINDS, *_OTHERS, *_MARKS)))
    return pair._replace(value=rng.choice((number_text(rng), number_text(rng), rng.choice(TEXTS))))


def drawing(rng: random.Random) -> list[Pair]:
    """A drawing of its own: header, layers, blocks in blocks, and entities of every kind."""
    tags = list[Pair]()
    if rng.random() < 0.5:
        tags += _section("HEADER", _header(rng))
    if rng.random() < 0.4:
        tags += _section("TABLES", _layers(rng))
    blocks = rng.choice((0, 0, 1, 2, 5))
    if blocks:
        tags += _section("BLOCKS", [tag for number in range(blocks) for tag in _block(rng, number, blocks)])
    entities = [tag for _ in range(rng.choice((1, 2, 4, 9))) for tag in _entity(rng, blocks)]
    tags += _section("ENTITIES", entities)
    return [*tags, *_pairs((0, "EOF"))] if rng.random() < 0.95 else tags


def _pairs(*groups: tuple[int, object]) -> list[Pair]:
    return [Pair(str(code), str(value)) for code, value in groups]


def _section(name: str, tags: list[Pair]) -> list[Pair]:
    return [*_pairs((0, "SECTION"), (2, name)), *tags, *_pairs((0, "ENDSEC"))]


def _header(rng: random.Random) -> list[Pair]:
    tags = _pairs((9, "$ACADVER"), (1, rng.choice(_VERSIONS)))
    if rng.random() < 0.6:
        tags += _pairs((9, "$INSUNITS"), (70, rng.choice((0, 1, 2, 4, 5, 6, 8, 13, 21, -1, "x", 4.5))))
    if rng.random() < 0.3:
        tags += _pairs((9, "$DWGCODEPAGE"), (3, rng.choice(("ANSI_936", "ANSI_950", "ANSI_1252", "utf8", "x"))))
    return tags


def _layers(rng: random.Random) -> list[Pair]:
    tags = _pairs((0, "TABLE"), (2, "LAYER"), (70, 3))
    for name in rng.sample(_LAYERS, rng.randint(0, 3)):
        tags += _pairs((0, "LAYER"), (2, name), (70, rng.choice((0, 1, 4, 64))), (62, rng.choice((7, -7, 0, 300))))
    return [*tags, *_pairs((0, "ENDTAB"))]


def _block(rng: random.Random, number: int, blocks: int) -> list[Pair]:
    tags = _pairs((0, "BLOCK"), (8, "0"), (2, f"B{number}"), (70, 0), (10, _number(rng)), (20, _number(rng)))
    for _ in range(rng.choice((0, 1, 2, 4))):
        tags += _insert(rng, blocks) if rng.random() < 0.5 else _entity(rng, blocks)
    return [*tags, *_pairs((0, "ENDBLK"))]


def _insert(rng: random.Random, blocks: int) -> list[Pair]:
    tags = _pairs((0, "INSERT"), (8, rng.choice(_LAYERS)), (2, f"B{rng.randint(0, max(blocks, 1))}"), *_at(rng))
    for code, share in ((41, 0.3), (42, 0.3), (43, 0.1), (50, 0.3)):
        tags += _pairs((code, _number(rng))) if rng.random() < share else []
    if rng.random() < 0.2:
        counts = rng.choice(((2, 3), (100, 100), (-32767, 2), (0, 0), (-1, 5)))
        tags += _pairs((70, counts[0]), (71, counts[1]), (44, _number(rng)), (45, _number(rng)))
    return tags


def _entity(rng: random.Random, blocks: int) -> list[Pair]:
    kind = rng.choice((*_KINDS[:4], *_KINDS, "TEXT", "SOLID"))
    if kind == "INSERT":
        return _insert(rng, blocks)
    tags = _pairs((0, kind), (100, "AcDbEntity"), (8, rng.choice(_LAYERS)), (100, _CLASSES.get(kind, f"AcDb{kind}")))
    if rng.random() < 0.1:
        tags += _pairs((210, _number(rng)), (220, _number(rng)), (230, rng.choice((1.0, -1.0, 0.0))))
    return [*tags, *_OF.get(kind, _at)(rng)]


def _at(rng: random.Random) -> list[Pair]:
    tags = _pairs((10, _number(rng)), (20, _number(rng)))
    return [*tags, *_pairs((30, _number(rng)))] if rng.random() < 0.2 else tags


def _line(rng: random.Random) -> list[Pair]:
    return [*_at(rng), *_pairs((11, _number(rng)), (21, _number(rng)))]


def _circle(rng: random.Random) -> list[Pair]:
    return [*_at(rng), *_pairs((40, _number(rng)))]


def _arc(rng: random.Random) -> list[Pair]:
    return [*_circle(rng), *_pairs((50, _number(rng, 360)), (51, _number(rng, 360)))]


def _ellipse(rng: random.Random) -> list[Pair]:
    return [*_line(rng), *_pairs((40, _number(rng, 1)), (41, _number(rng, 7)), (42, _number(rng, 7)))]


def _lwpolyline(rng: random.Random) -> list[Pair]:
    number = rng.choice((0, 1, 2, 4, 4, 12))
    tags = _pairs((90, number), (70, rng.choice((0, 1, 1, 128))))
    for _ in range(number):
        tags += [*_at(rng)[:2], *_bulge(rng)]
    return tags


def _polyline(rng: random.Random) -> list[Pair]:
    tags = _pairs((66, 1), (70, rng.choice((0, 1, 1, 4, 8, 16, 64))))
    for _ in range(rng.choice((0, 1, 2, 4))):
        tags += [*_pairs((0, "VERTEX"), (8, "0")), *_at(rng), *_bulge(rng)]
    return [*tags, *_pairs((0, "SEQEND"))] if rng.random() < 0.9 else tags


def _bulge(rng: random.Random) -> list[Pair]:
    return _pairs((42, rng.choice((1.0, -1.0, 0.5, 1e-9, 1e12, -1e300, _number(rng, 2))))) if rng.random() < 0.4 else []


def _spline(rng: random.Random) -> list[Pair]:
    degree, points = rng.choice((1, 2, 3, 3, 5, 0, 11, 200)), rng.choice((0, 2, 4, 6, 9))
    knots = [0.0] * (degree + 1) + [1.0] * max(points - degree, 0) + [float(rng.randint(0, 3))] * (degree % 20)
    tags = _pairs((70, rng.choice((0, 1, 8, 11))), (71, degree), (72, len(knots)), (73, points))
    tags += _pairs(*((40, knot if rng.random() < 0.95 else _number(rng)) for knot in knots))
    if rng.random() < 0.2:
        tags += _pairs(*((41, _number(rng, 3)) for _ in range(points)))
    for _ in range(points):
        tags += _at(rng)
    return tags


_OF = {
    **{"LINE": _line, "ARC": _arc, "CIRCLE": _circle, "ELLIPSE": _ellipse, "LWPOLYLINE": _lwpolyline},
    **{"POLYLINE": _polyline, "SPLINE": _spline},
}


def _number(rng: random.Random, most: float = 20.0) -> str:
    what = rng.random()
    if what < 0.9:
        return repr(round(rng.uniform(-most, most), rng.choice((0, 1, 3, 16))))
    return number_text(rng)


def _text(rng: random.Random, pairs: "list[Pair] | tuple[Pair, ...]") -> bytes:
    end = rng.choice(("\n", "\n", "\r\n"))
    text = "".join(f"{code}{end}{value}{end}" for code, value in pairs)
    return text.encode(rng.choice(("utf-8", "utf-8", "gb18030")), "replace")


def _binary(pairs: list[Pair]) -> bytes:
    """The pairs as binary DXF of R12: codes of a byte, values by the ranges of the DXF reference."""
    data = [_BINARY]
    for code, value in pairs:
        try:
            data.append(_group(int(code), value))
        except (ValueError, struct.error, OverflowError):
            data.append(b"\xff")
    return b"".join(data)


def _group(code: int, value: str) -> bytes:
    head = struct.pack("<B", code) if code < 255 else struct.pack("<BH", 255, code)
    if 10 <= code <= 59 or 140 <= code <= 147 or 210 <= code <= 239 or 1010 <= code <= 1059:
        return head + struct.pack("<d", float(value))
    if 60 <= code <= 79 or 170 <= code <= 175 or 1060 <= code <= 1070:
        return head + struct.pack("<h", int(value))
    if 90 <= code <= 99 or code == 1071:
        return head + struct.pack("<l", int(value))
    return head + value.encode("utf-8", "replace") + b"\0"
