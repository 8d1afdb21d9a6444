"""Programs as bad for a reader as a small file can be: huge numbers, endless lines, a million of everything."""

from collections.abc import Callable

SQUARE = "B1000B0B1000GXL1\nB0B1000B1000GYL2\nB1000B0B1000GXL3\nB0B1000B1000GYL4\n"
CIRCLE = "B100B0B400GYNR1\n"
_SQUARE_4B = SQUARE.replace("G", "B0G")
_JUMP = "D\nB300B0B300GXL1\nD\n"

HOSTILE: dict[str, Callable[[int], str]] = {
    "count of 10^30": lambda n: f"B1000B0B{10**30}GXL1\nDD\n",
    "counts of 999,999,999": lambda n: "B999999999B0B999999999GXL1\n" * 1000 + "DD\n",
    "a number of a million digits": lambda n: f"B1000B0B{'9' * (10 * n)}GXL1\nDD\n",
    "a million leading zeros": lambda n: f"B1000B0B{'0' * (10 * n)}1000GXL1\nDD\n",
    "a printed end of a million digits": lambda n: f"B1000B0B1000GXL1;{'1' * (10 * n)},0.000\nDD\n",
    "arcs of many turns": lambda n: "B2B0B99999GYNR1\n" * 1000 + "DD\n",
    "10^5 blocks on one line": lambda n: SQUARE.replace("\n", "") * (n // 4) + "DD",
    "10^5 parentheses": lambda n: "(" * n + SQUARE + ")" * n + "DD\n",
    "10^5 pairs of parentheses": lambda n: SQUARE + "()" * n + "DD\n",
    "a million blanks": lambda n: f"B1000{' ' * (10 * n)}B0B1000GXL1\nDD\n",
    "a million tabs in a damaged block": lambda n: f"B1000B0B1000{chr(9) * (10 * n)}ZXL1\nDD\n",
    "a million newlines": lambda n: SQUARE + "\n" * (10 * n) + "DD\n",
    "10^5 D": lambda n: SQUARE + "D\n" * n + SQUARE + "DD\n",
    "10^5 times one label": lambda n: ("N1:" + SQUARE.replace("\n", "\nN1:")[:-3]) * (n // 4) + "DD\n",
    "10^5 start nodes": lambda n: SQUARE + "Start Point = 1.0 , 2.0\n" * n + "DD\n",
    "start nodes between 25,000 figures": lambda n: (SQUARE + "D\nStart Point = 9.0 , 9.0\n") * (n // 4) + "DD\n",
    "10^5 tiny contours": lambda n: (CIRCLE + _JUMP) * n + "DD\n",
    "25,000 squares with jumps": lambda n: (SQUARE + _JUMP) * (n // 4) + "DD\n",
    "10^5 pauses inside one contour": lambda n: "B10B0B10GXL1\nD\n" * n + "DD\n",
    "10^5 pauses in a zigzag": lambda n: "B10B5B10GXL1\nB5B9B9GYL2\nB9B5B9GXL3\nB3B8B8GYL4\nD\n" * (n // 4) + "DD\n",
    "10^5 identical circles": lambda n: "B5000B0B20000GYNR1\n" * (n // 10) + "DD\n",
    "10^5 identical small circles": lambda n: CIRCLE * n + "DD\n",
    "20,000 circles with a jump of 1 µm": lambda n: (CIRCLE + "D\nB0B0B1GXL1\nD\n") * (n // 5) + "DD\n",
    "20,000 circles with pauses": lambda n: (CIRCLE + "D\n") * (n // 5) + "DD\n",
    "10^5 lines of a star": lambda n: "B9000B100B9000GXL1\nB9000B101B9000GXL3\n" * (n // 20) + "DD\n",
    "an open contour of 10^5 blocks": lambda n: SQUARE * (n // 4) + "B700B300B700GXL1\nDD\n",
    "10^4 open contours": lambda n: (SQUARE + "B700B300B700GXL1\n" + _JUMP) * (n // 10) + "DD\n",
    "10^5 damaged blocks": lambda n: SQUARE + "B1000B0B1000ZXL1\n" * n + "DD\n",
    "10^5 damaged blocks on one line": lambda n: SQUARE + "B1000B0B1000ZXL1" * n + "\nDD\n",
    "10^5 lines of other text": lambda n: SQUARE + "?????\n" * n + "DD\n",
    "a million question marks": lambda n: SQUARE + "?" * (10 * n) + "\nDD\n",
    "a million letters B": lambda n: SQUARE + "B" * (10 * n) + "\nDD\n",
    "a million letters B alone": lambda n: "B" * (10 * n),
    "a million letters B and blanks": lambda n: SQUARE + "B " * (10 * n) + "\nDD\n",
    "a million letters N": lambda n: SQUARE + "N" * (10 * n) + "\nDD\n",
    "10^5 labels without blocks": lambda n: SQUARE + "N1:" * n + "\nDD\n",
    "a million digits alone": lambda n: SQUARE + "1" * (10 * n) + "\nDD\n",
    "10^5 numbers alone": lambda n: SQUARE + "B1" * n + "\nDD\n",
    "10^5 semicolons": lambda n: SQUARE + ";" * n + "\nDD\n",
    "10^5 remarks with blocks": lambda n: SQUARE + ";B1B1B1GXL1\n" * n + "DD\n",
    "a remark with 10^5 blocks": lambda n: SQUARE + ";" + "B1B1B1GXL1" * n + "\nDD\n",
    "10^5 printed ends that are wrong": lambda n: "B10B0B10GXL1;1.000,1.000\nB10B0B10GXL3;0.000,3.000\n" * (n // 2),
    "10^5 blocks of 4B": lambda n: "B10B0B10B0GXL1\nB10B0B10B0GXL3\n" * (n // 2) + "DD\n",
    "every other block of 4B": lambda n: "B10B0B10B0GXL1\nB10B0B10GXL3\n" * (n // 2) + "DD\n",
    "4B behind 10^5 damaged blocks": lambda n: "B1B2B3 B4B5B6GXL1 B4B5B6GXL1 B4B5B6GXL1\n" * (n // 3) + "DD\n",
    "a million lengths": lambda n: "Length=" * n + "\n" + SQUARE + "DD\n",
    "10^4 header lengths": lambda n: "Length=1.0\n" * (n // 10) + SQUARE + "DD\n",
    "10^4 start nodes with a length": lambda n: (
        (SQUARE + "D\nStart Point = 1.0 , 2.0 ; Length = 4.0\n") * (n // 10) + "DD"
    ),
    "10^5 wrong count axes": lambda n: "B990B0B3960GXNR4\n" * (n // 10) + "DD\n",
    "10^5 blocks that never end": lambda n: "B0B10B10GXL1\n" * n + "DD\n",
    "full turns beyond any table": lambda n: "B100B0B999999999GYNR1\nDD\n",
    "20,000 squares of 4B": lambda n: (_SQUARE_4B + "D\nB3000B0B3000B0GXL1\nD\n") * (n // 5) + "DD\n",
    "16,000 squares with tabs": lambda n: (
        (SQUARE.replace("B1000B1000GYL4", "B500B500GYL4\nD\nB0B500B500GYL4") + _JUMP) * (n // 6) + "DD\n"
    ),
    "10^5 zigzags on one another": lambda n: (
        "B1000B0B1000GXL1\nB0B10B10GYL2\nB1000B0B1000GXL3\nB0B10B10GYL2\n" * (n // 4) + "DD\n"
    ),
    "circles that overlap, each by 1 µm more": lambda n: (
        "".join(f"B{5000 + at}B0B{4 * (5000 + at)}GYNR1\nD\nB10B0B10GXL1\nD\n" for at in range(n // 10)) + "DD\n"
    ),
    "10^5 blocks of no length": lambda n: "B0B0B0GXL1\n" * n + "DD\n",
}
"""Name -> the program, from the number that its name calls 10^5: the tests that run each time take fewer."""
