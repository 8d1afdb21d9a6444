"""PMAC motion programs that nobody would write: sound ones damaged, and their lines thrown together."""

import random
import re

from fuzzing.mutate import damaged, edited

_HEAD = "CLOSE\n&1\n#1->1000X\n#2->1000Y\nI5113=10\nI5190=60000\n"
SEEDS = (
    _HEAD + "OPEN PROG 1\nCLEAR\nABS\nFRAX(X,Y)\nLINEAR X10 F60\nY10\nX0\nDWELL0\nX0 Y0\nCLOSE\n",
    _HEAD + "OPEN PROG 1\nCLEAR\nNORMAL K-1\nCIRCLE2 X0 Y0 I-10 J0 F60\nSTOP\nPSET X50 Y0\nCIRCLE1 X50 I5\nCLOSE\n",
    _HEAD + "OPEN PROG 1000\nCLEAR\nRAPID RET\nN1000 LINEAR RET\nN3000 CIRCLE2 RET\nN90000 ABS\nRET\nCLOSE\n"
    "OPEN PROG 1\nCLEAR\nG90 G00 X1 Y2\nG01 X11 F120 ; there\nG03 Y12 J5\nCLOSE\n",
    "Coord[1].SegMoveTime=10\nCoord[1].FeedTime=60000\nopen prog 1\n"
    "inc\nta 10 ts 0\nlinear x10 f60 // on\ny(-10)\nclose\n",
)
_WORDS = (
    "OPEN PROG 99999999999999999999",
    *("OPEN PROG 1", "OPEN PROG 1000", "CLEAR", "CLOSE", "RET", "RAPID", "LINEAR", "CIRCLE1", "CIRCLE2", "ABS", "INC"),
    *("ABS(R)", "INC(X)", "FRAX(X)", "NORMAL K-1", "NORMAL", "DWELL0", "TA0", "TS0", "TA-1", "STOP", "PSET X1"),
    *("PSET", "X", "X-", "X1e9", "X99999999999999999999", "F0", "F-1", "R0", "R5", "I0 J0", "Z1", "G01", "G99", "M3"),
    *(
        "N1000:",
        "N99999999999999999999",
        "P1=2",
        "WHILE(P1<2)",
        "(",
        ")",
        ";",
        "//",
        "?",
        "SPLINE1",
        "IF(P1=0)",
        "ELSE",
        "ENDIF",
        "ENDWHILE",
        "X(P1+1)",
        "P(P1)=",
        "GOTO5",
        "CALL1000.5",
        "READ(X)",
        "#define X X",
        "#ifdef X",
        "{",
        "}",
        "I5113=0",
        "G1000",
    ),
    *(
        "\n",
        "\r",
        " ",
        "\t",
        "\0",
        "加工",
        "Ｘ１",
        "ß",
        "\u2028",
        "B1R",
        "&1",
        "#1->",
        "OPEN PROG 99999999999999999999",
    ),
)


def fuzzed_pmac(rng: random.Random) -> bytes:
    """One input."""
    others = [seed.encode() for seed in SEEDS]
    if rng.random() < 0.4:
        return damaged(rng, rng.choice(others), others)
    text = rng.choice(SEEDS)
    for _ in range(rng.choice((1, 1, 2, 4))):
        parts = re.split("(?<=\n)" if rng.random() < 0.3 else r"(?<=[\s;])", text)
        text = "".join(edited(rng, parts, lambda _: rng.choice(_WORDS)))
    return text.encode()
