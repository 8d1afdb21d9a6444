"""How the pictures look: every colour, size and font, and nothing else.

Sizes are px of a picture 1600 px wide; smaller pictures scale them. The palette follows Okabe and Ito, which the
colour-blind can tell apart; still every mark differs by its shape too, so that a grey print says the same.
"""

from pathlib import Path
from typing import Final

Colour = tuple[int, int, int]

FONT: Final = Path(__file__).with_name("fonts") / "NotoSansCJKsc-Regular-subset.otf"

WHITE: Final[Colour] = (255, 255, 255)
INK: Final[Colour] = (26, 26, 26)
GREY: Final[Colour] = (95, 95, 95)
FRAME: Final[Colour] = (150, 150, 150)
GRID: Final[Colour] = (232, 232, 232)
KERF: Final[Colour] = (118, 194, 238)
IDEAL: Final[Colour] = INK
JUMP: Final[Colour] = (213, 94, 0)
START: Final[Colour] = (0, 138, 101)
END: Final[Colour] = (158, 50, 120)
WORK: Final[Colour] = (248, 243, 230)
WORK_EDGE: Final[Colour] = (176, 158, 116)
CLAMP: Final[Colour] = (226, 226, 226)
CLAMP_EDGE: Final[Colour] = (130, 130, 130)

BASE_WIDTH: Final = 1600
LEAST_WIDTH: Final = 600
LEAST_UNIT: Final = 0.45  # text of a small picture stays readable

HEIGHT_RANGE: Final = (0.5, 1.0)  # height of a picture over its width

TITLE: Final = 38.0
NOTE: Final = 26.0
TEXT: Final = 23.0
TICK: Final = 23.0
NUMBER: Final = 21.0

EDGE: Final = 30.0  # free border of the page
LEFT: Final = 104.0  # room for the labels of the Y axis
HEAD: Final = 132.0  # title and note
FOOT: Final = 184.0  # labels of the X axis and legend
LEGEND_ROW: Final = 37.0
SAMPLE: Final = 64.0  # width of a legend's sample
LEGEND_GAP: Final = 14.0
PAD: Final = 56.0  # free border inside the frame, room for block numbers

BODIES_NEAR: Final = 0.15  # bodies show as far from the path as this share of its longer side
BODY_EDGE: Final = 2.0
HATCH: Final = 12.0  # from line to line
HATCH_WIDTH: Final = 1.0

TICK_SPACING: Final = 120.0
SCALE_BAR: Final = 260.0  # the longest

IDEAL_WIDTH: Final = 1.0
KERF_WIDTH_MIN: Final = 4.0  # thinner, it would hide under the programmed path
JUMP_WIDTH: Final = 2.0
DASH: Final = 11.0
DASH_GAP: Final = 8.0
GRID_WIDTH: Final = 1.0
MARK: Final = 12.0  # radius of the start ring; the end's cross reaches further, so both show in one place
MARK_WIDTH: Final = 3.5
CROSS: Final = 20.0
ARROW: Final = 19.0
ARROW_BLOCK_MIN: Final = 60.0
ARROW_SPACING: Final = 300.0
NUMBER_GAP: Final = 7.0
NUMBER_INSET: Final = 5.0
