"""3B and 4B that nobody would write: sound programs damaged, their tokens changed or thrown together."""

import codecs
import random
import re
from functools import cache

from places import CORPUS, SCENARIOS

from fuzzing.mutate import damaged, edited

SEEDS = (
    "B10000B0B10000GXL1\nB0B10000B10000GYL2\nB10000B0B10000GXL3\nB0B10000B10000GYL4\nDD\n",
    "B9900B0B9900GXL1B0B9900B9900GYNR2 B0B9900B29700GXNR2 B9900B0B9900GXL3D B30000B0B30000GXL1 B9900B0B39600GYNR1 DD",
    "N1: B0 B24900 B24900 GYL2;0.000,24.900//in\r\nN2: B0 B24900 B49800 GXNR2 ; -0.000 , -24.900\r\n"
    "N3: B56757 B0 B56757 GXL1;56.757,-24.900\r\nN4: B43243 B24900 B149800 GY NR3;56.756,24.898\r\n"
    "N5: B56756 B2 B56756 GXL2;0.000,24.900\r\nN6: B0 B24900 B24900 GYL4;0.000,0.000\r\nN7: DD//\r\n",
    "CAXAWEDM -Version 2.0 , Name : 加工.3B\nConner R= 0.00000 , Offset F= 0.10000 ,Length= 40.0 mm\n****\n"
    "Start Point = 0.0 , 0.0 ; Length = 40.0\nBBB10000GXL1\nBBB10000GYL2\nBBB10000GXL3\nBBB10000GYL4\nDD\n",
    "B10000B0B10000B0GXL1\nB0B5000B10000B5000DGXNR4\nB10000 B B10000 B0 GX L3\nB0B5000B10000B5000GX DD NR2\nDD\n",
    "; 穿丝 (slug)\nB1B1B5000GYL1\nD\nStart Point = 1.0 , 2.0\nB100B0B400GYNR1\nE\nB1B1B1GXL1\n",
)
"""One of each way of writing; corpus and scenarios give the others."""
_ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "gb18030", "big5", "latin-1", "utf-16-le", "utf-16-be", "utf-32")
_LONGEST_SEED = 20_000
_TOKEN = re.compile(r"\d+|[^\W\d]+|\s+|.", re.DOTALL)
_NUMBERS = (
    *("", "0", "1", "2", "00", "3", "400", "999999999", "1000000000", "9" * 40, "-5", "1.5", "１２", "٣", "1e9", "²"),
)
_WORDS = (
    *(
        "B",
        "b",
        "Ｂ",
        "GX",
        "GY",
        "gx",
        "G X",
        "GZ",
        "G",
        "L1",
        "L2",
        "L3",
        "L4",
        "L5",
        "NR1",
        "SR4",
        "nr2",
        "SR",
        "NR0",
    ),
    *(
        "D",
        "DD",
        "DDD",
        "d",
        "E",
        "FF",
        "MJ",
        "N1:",
        "N1",
        "7:",
        "7 ",
        "N",
        "Start Point = 1.0 , -2.0",
        "Start Point =",
    ),
    *("// drycut: ignore 3B204", "; drycut: ignore-file 3B1", "(drycut: ignore)", "//drycut: ignore 3B, x"),
    *("Start Point = 9999999999.0 , 1.0", "Length= 1.0 mm", "Length=" + "9" * 30, "CAXA", "Offset F= 0.0", "****"),
    *(
        ";1.000,2.000",
        "; 0.000 , 0.000",
        ";",
        "//",
        "//加工",
        "(",
        ")",
        "(B1B1B1GXL1)",
        ";B1B1B1GXL1",
        ";-0.000,1e5",
        "?",
    ),
    *(
        " ",
        "\t",
        "\n",
        "\r\n",
        "\r",
        "\u3000",
        "\xa0",
        "\u2028",
        "\x0b",
        "\x0c",
        "\x85",
        "\x1a",
        "\ufeff",
        "\U0001f600",
    ),
)


@cache
def programs() -> tuple[bytes, ...]:
    """Programs of the repository, as they are."""
    files = [*CORPUS.glob("*/*.[34]b"), *SCENARIOS.glob("*/program.*")]
    found = [file.read_bytes() for file in sorted(files)]
    return (*(seed.encode() for seed in SEEDS), *(data for data in found if len(data) < _LONGEST_SEED))


def fuzzed_program(rng: random.Random) -> bytes:
    """One input."""
    kind = rng.random()
    if kind < 0.4:
        return damaged(rng, _encoded(rng, _recombined(rng)), programs())
    data = rng.choice(programs())
    if kind < 0.7:
        return damaged(rng, data, programs())
    try:
        return _encoded(rng, changed(rng, data.decode()))
    except UnicodeDecodeError:
        return damaged(rng, data, programs())


def changed(rng: random.Random, text: str) -> str:
    """Lines or tokens changed, moved, doubled or left out."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        pattern = "(?<=\n)" if rng.random() < 0.3 else ""
        parts = re.split(pattern, text) if pattern else _TOKEN.findall(text)
        text = "".join(edited(rng, parts, lambda part: _other(rng, part)))
    return text


def _other(rng: random.Random, part: str) -> str:
    if not part.isdecimal():
        return rng.choice(_WORDS)
    near = str(max(0, int(part[:15]) + rng.choice((-1000, -2, -1, 1, 2, 1000)))) if part.isascii() else "1"
    return rng.choice((near, near, f"{part}0", part[:-1], part[::-1], _number(rng)))


def _recombined(rng: random.Random) -> str:
    """Tokens in any order, blocks with hostile numbers among them."""
    parts = [_block(rng) if rng.random() < 0.6 else rng.choice(_WORDS) for _ in range(rng.randint(1, 25))]
    return rng.choice(("", " ", "\n", "\r\n")).join(parts)


def _block(rng: random.Random) -> str:
    blank = rng.choice(("", "", " ", "\t", "\u3000"))
    x, y, count = (_number(rng) for _ in range(3))
    radius = [f"B{_number(rng)}"] if rng.random() < 0.1 else []
    curve = [rng.choice(("D", "DD"))] if rng.random() < 0.1 else []
    sense = rng.choice(("L", "NR", "SR")) + str(rng.randint(1, 4))
    block = blank.join([f"B{x}", f"B{y}", f"B{count}", *radius, *curve, rng.choice(("GX", "GY")), sense])
    return block + (f";{_number(rng)}.{_number(rng)},-1.000" if rng.random() < 0.1 else "")


def _number(rng: random.Random) -> str:
    return str(rng.randint(0, 30_000)) if rng.random() < 0.8 else rng.choice(_NUMBERS)


def _encoded(rng: random.Random, text: str) -> bytes:
    if rng.random() < 0.05:
        at = rng.randint(0, len(text))
        return codecs.BOM_UTF16_LE + (text[:at] + "\udc00" + text[at:]).encode("utf-16-le", "surrogatepass")
    encoding = rng.choice(_ENCODINGS) if rng.random() < 0.3 else "utf-8"
    return text.encode(encoding, "replace")
