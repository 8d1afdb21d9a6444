"""How the pictures look: every size and the font; colours are those of `sim.show.draw.paints`.

Sizes are px of a picture 1600 px wide; smaller pictures scale them.
"""

from pathlib import Path
from typing import Final

FONT: Final = Path(__file__).with_name("fonts") / "NotoSansCJKsc-Regular-subset.otf"


BASE_WIDTH: Final = 1600
LEAST_WIDTH: Final = 600
LEAST_THUMBNAIL: Final = 160
MOST_WIDTH: Final = 10_000  # an A0 page at 200 dpi
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

PAUSE: Final = 26.0  # side of a pause's square
FLAG: Final = 17.0  # how far a finding's marker reaches

SIZE: Final = 22.0  # text of sizes and labels
SIZE_PAD: Final = 122.0  # free border inside the frame where sizes stand
SIZE_AWAY: Final = 66.0  # from the path to a line of sizes
SIZE_GAP: Final = 8.0
SIZE_WIDTH: Final = 1.5
SIZE_ARROW: Final = 15.0
LEADER: Final = 34.0  # from an arc to its radius
LINE_STEP: Final = 1.25  # from line to line of a text, in its size

EDGE_WIDTH: Final = 1.5  # of pieces
ACTUAL_WIDTH: Final = 2.2
CONTOUR_WIDTH: Final = 1.5
TABLE: Final = 84.0  # the longer side of the small table in the head
THUMBNAIL_PAD: Final = 26.0
