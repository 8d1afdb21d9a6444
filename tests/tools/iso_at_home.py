"""ISO programs whose truth stands beside them: two rounds by one subprogram, and a die that compensates."""

import math

ROUNDS = """\
%
N10 G92 X0 Y0
N20 G90
N30 M98 P100
N40 M00
N50 G92 X30000 Y0
N60 M98 P200
N70 M98 P200
N80 M02
N100
N110 G01 X5000 Y0
N120 G03 X5000 Y0 I-5000 J0
N130 G01 X0 Y0
N140 M99
N200
N210 G01 X35000 Y0
N220 G03 X35000 Y0 I-5000 J0
N230 G01 X30000 Y0
N240 M99
%
"""
"""One hole of R 5 at (0, 0), and one at (30, 0) cut twice; a rethread between them."""
ROUNDS_CUT_UM = 3 * (2 * 5000.0 + math.tau * 5000.0)
ROUNDS_BOX_UM = [-5000.0, -5000.0, 35000.0, 5000.0]

DIE = """\
G92 X0 Y0
G90
G41 D1
G01 X10000 Y0
G01 X10000 Y5000
G01 X-10000 Y5000
G01 X-10000 Y-5000
G01 X10000 Y-5000
G01 X10000 Y0
G40
G01 X0 Y0
M02
"""
"""An opening of 20 x 10 mm, the wire on its left, inside."""
