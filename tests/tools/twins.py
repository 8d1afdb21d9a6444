"""One part in 3B and in ISO, as a CAM wrote both: they answer a question on the page "3b加工代码文件" of duolatom."""

BLOCKS_3B = """\
B 9900 B 0 B 9900 GX L3
B 0 B 70100 B 70100 GY L2
B 55000 B 0 B 55000 GX L3
B 50100 B 100 B 100000 GY NR1
B 54900 B 0 B 54900 GX L3
B 0 B 40100 B 80100 GX NR2
B 0 B 40000 B 40000 GY L4
B 60200 B 0 B 60200 GX L1
B 39900 B 100 B 80000 GY SR3
B 70200 B 0 B 70200 GX L1
B 0 B 50100 B 50100 GY L2
B 9900 B 0 B 9900 GX L1"""

BLOCKS_ISO = """\
G01 X-9900 Y0
G01 X0 Y70100
G01 X-55000 Y0
G03 X-100200 Y0 I-50100 J-100
G01 X-54900 Y0
G03 X-100 Y-80200 I0 J-40100
G01 X0 Y-40000
G01 X60200 Y0
G02 X79800 Y0 I39900 J100
G01 X70200 Y0
G01 X0 Y50100
G01 X9900 Y0"""

HEAD_ISO = "G91G92 X115000 Y-10000"
START_3B = "Start Point = 115.00000 , -10.00000 ; X , Y"

TWIN_ISO = f"{HEAD_ISO}\n{BLOCKS_ISO}\nM02\n"
TWIN_3B = f"{START_3B}\n{BLOCKS_3B}\nDD\n"

PAIRS = (
    ("G03 X-100200 Y0 I-50100 J-100", "B50100B100B100000GYNR1"),
    ("G03 X-100 Y-80200 I0 J-40100", "B0B40100B80100GXNR2"),
    ("G02 X79800 Y0 I39900 J100", "B39900B100B80000GYSR3"),
)
"""Arcs of it."""


def motion(text: str) -> list[str]:
    """The blocks of a program that move, without blanks, labels and what is printed behind them."""
    blocks = []
    for line in text.splitlines():
        block = line.split(": ", 1)[-1].split(" ; ")[0].replace(" ", "")
        if block.startswith(("B", "G00", "G01", "G02", "G03")):
            blocks.append(block)
    return blocks
