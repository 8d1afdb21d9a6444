"""ISO that nobody would write: sound programs of every family damaged, their words changed or thrown together."""

import random
import re

from fuzzing.mutate import NUMBERS, damaged, edited

SEEDS = (
    "G91G92 X10000 Y-5000\nG01 X0 Y5000\nG01 X10000 Y0\nG03 X0 Y10000 I0 J5000\nG01 X-10000 Y0\nG01 X0 Y-10000\n"
    "G01 X0 Y-5000\nM02\n",
    "N10 G92 X0 Y0\nN20 G91\nN30 G01 X10 Y20\nN40 G02 X30 Y0 I15 J0\nN50 G01 X-30\nN60 M02\n",
    "; made for tests\n; Number : 1\nH001=110\nE001=   004 005 006\nG90 G92 X0 Y0\nG41 H001\nM98 P0001\nG40 G00 X0 Y0\n"
    "M00\nG92 X20000 Y0\nM98 P0001\nM02\nN0001\nG01 X5000 Y0\nG03 X5000 Y0 I-5000 J0\nM99\n",
    "% (MEM:F17A15.ISO)\r\nN10 G92 X0 Y0\r\nN20 G60\r\nN30 G38\r\nN40 G41 D0\r\nN50 G90 G01 X5000 Y0\r\n"
    "N60 G03 X-5000 Y0 I0 J0\r\nN70 X5000 Y0 I0 J0\r\nM01\r\nN80 G40\r\nN90 G00 X0 Y0\r\nN100 M02\r\n%\r\n",
    "C000   = 012 014 -01;\nH000 = +000000.0100 ;\nH001 = +000000.1000 ;\nQAIC(2,1,0.1250,3);\nG55;\nG90;\n"
    "G92 X0 Y0 Z0;\nT94;\nT84;\nC000;\nG41 H000 G01 X10. Y0.;\nC001 H001;\nM98 P0001;\nG40 H000 G01 X0. Y0.;\nT85;\n"
    "M02;\nN0001;\nG01 Y10.;\nG03 X-10. Y10. I-10. J0.;\nG01 Y0. : G01 Y1. ;\nX10.;\nM99;\n",
    "%\nL001\n SQUARE PROGRAM \nH175 = .0002\nH1 =.00995 + H175\nG90 M91\nG92 X0. Y0.\nM20\nM78 M78\nE1281 F.06\n"
    "G42 H1 G1 Y-.5\nX-.5\nY-1.5\nG02 X.5 Y-1.5 I.5\nG1 Y-.5\nM01\nX0.\nG40 Y0.\nM85 M83 M81\nM21 M58\nM02\n%\n",
    "%\nO0027\nG91 S1 D1\nG92 X0 Y0\nG42 (SIDE)\n/G01 X.5\nG01 X.5 Y-.25 F1.\nG03 I0.25 X.25 Y.25\nG02 X1. R.6\n"
    "G40 G01 X-2.25\nM60\nM30\n%\n",
    "N06 G90 G41 D11 G01 X200 Y300 F200 ;\n#100 = 5\nIF [#100 GT 4] GOTO 20\nN20 G51 A1.5\nG01 U.1 V-.1 X1. Y1.;\n"
    "M02;\n",
)
"""One program of each family, and one of words that are not simulated."""
_ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "gb18030", "big5", "latin-1")
_TOKEN = re.compile(r"[A-Za-z]|[-+]?\d+\.?\d*|\s+|.", re.DOTALL)
_LETTERS = "GGGXXXYYYIJRMNDHFSTAUVKPQLEOCWZB"
_WORDS = (
    *("G00", "G01", "G02", "G03", "G04", "G17", "G20", "G21", "G40", "G41", "G42", "G50", "G51", "G52", "G54", "G60"),
    *("G38", "G90", "G91", "G90.1", "G91.1", "G92", "G92 X0 Y0", "G123", "G1.5", "M00", "M01", "M02", "M20", "M21"),
    *("M30", "M98 P0001", "M98 P1 L3", "M98 P9", "M99", "N1", "N0001", "N10", "N-1", "O1", "O0001", "P1", "L2", "D0"),
    *("D1", "D11", "H001", "H001=110", "H1 =.0085 + H175", "H1 = -0.1", "H1=", "D1=D1", "C001 = 012 014", "QAIC(1,2);"),
    *("E001", "S1", "F.06", "T84", "A1.5", "U1 V1", "W3", "X", "X-", "X1..2", "X 1 0", "X+.5", "Y-.5", "R5", "R-5"),
    *("I0 J0", "I5", "J-5", "K1", "I.75 J-.25", "#100", "#100=1", "[", "]", "IF [#1 EQ 1] GOTO 1", "WHILE", "=", "+"),
    *("(", ")", "(remark)", "(drycut: ignore ISO212)", "; drycut: ignore-file ISO1", ";", "; G01 X1", ":", "%", "% x"),
    *("/", "/2", "TITLE", "加工", "B1B1B1GXL1", "g01", "Ｇ０１", "?", ",", "T1 M06", "S5000 M03", "G43 H1 Z5."),
    *(" ", "\t", "\n", "\r\n", "\r", "\u3000", "\xa0", "\u2028", "\x0b", "\x1a", "\0", "\ufeff", "\U0001f600"),
)


def fuzzed_iso(rng: random.Random) -> bytes:
    """One input."""
    kind, others = rng.random(), [seed.encode() for seed in SEEDS]
    if kind < 0.3:
        return damaged(rng, _encoded(rng, _recombined(rng)), others)
    if kind < 0.5:
        return damaged(rng, rng.choice(others), others)
    return _encoded(rng, changed(rng, rng.choice(SEEDS)))


def changed(rng: random.Random, text: str) -> str:
    """Lines, words, letters or numbers changed, moved, doubled or left out."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        kind = rng.random()
        parts = re.split("(?<=\n)" if kind < 0.3 else r"(?<=[\s;])", text) if kind < 0.6 else _TOKEN.findall(text)
        text = "".join(edited(rng, parts, lambda part: _other(rng, part)))
    return text


def _other(rng: random.Random, part: str) -> str:
    if len(part) == 1 and part.isalpha():
        return rng.choice(_LETTERS)
    if part.isdecimal() and part.isascii():
        near = str(int(part[:15]) + rng.choice((-1000, -2, -1, 1, 2, 1000)))
        return rng.choice((near, f"{part}0", f"{part}.", f"-{part}", part[:-1], _number(rng)))
    return rng.choice(_WORDS)


def _recombined(rng: random.Random) -> str:
    """Blocks of words in any order, forms and marks among them."""
    blocks = [_block(rng) if rng.random() < 0.7 else rng.choice(_WORDS) for _ in range(rng.randint(1, 25))]
    return rng.choice(("\n", "\n", "\r\n", " ;\n", " ", "")).join(blocks)


def _block(rng: random.Random) -> str:
    words = [rng.choice(("G01", "G02", "G03", "G1", "", "", "G00"))]
    words += [f"{letter}{_number(rng)}" for letter in rng.sample("XYXYIJR", rng.randint(0, 5))]
    words += [rng.choice(_WORDS)] * (rng.random() < 0.2)
    return rng.choice(("", " ", "\t")).join(words)


def _number(rng: random.Random) -> str:
    kind = rng.random()
    if kind < 0.4:
        return str(rng.randint(-20, 20) * 1000)
    if kind < 0.8:
        return f"{rng.randint(-20, 20) / rng.choice((1, 2, 8, 1000)):.{rng.randint(0, 5)}f}"
    return rng.choice(NUMBERS)


def _encoded(rng: random.Random, text: str) -> bytes:
    return text.encode(rng.choice(_ENCODINGS) if rng.random() < 0.3 else "utf-8", "replace")
