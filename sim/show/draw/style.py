"""How the pictures look: sizes, font, and colours by what they mean.

How the pictures look: every size and the font; colours are those of `sim.show.draw.style`.

Sizes are px of a picture 1600 px wide; smaller pictures scale them.

Colours by what they mean: pictures name a paint, a theme says which colour it is.

The palette follows Okabe and Ito, which the colour-blind can tell apart; still every mark differs by its shape too, so
that a grey print says the same.

The tone of each pass over an edge, and what a legend says of it: the first has that of the kerf, trims their own.
"""

from collections.abc import Iterable, Mapping
from enum import StrEnum
from pathlib import Path
from typing import Final, Literal, NamedTuple

from parser.findings.catalogue import Bilingual
from parser.shape.passes import Pass
from sim.show.texts import bilingual

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


Colour = tuple[int, int, int]
"""Red, green and blue, 0 to 255."""


class Paint(StrEnum):
    """What a colour stands for."""

    PAGE = "page"
    INK = "ink"
    GREY = "grey"
    FRAME = "frame"
    GRID = "grid"
    WORK = "work"
    WORK_EDGE = "work-edge"
    CLAMP = "clamp"
    CLAMP_EDGE = "clamp-edge"
    KERF = "kerf"
    LEAD = "lead"
    TRIM_1 = "trim-1"
    TRIM_2 = "trim-2"
    TRIM_3 = "trim-3"
    TRIM_4 = "trim-4"
    TRAVEL = "travel"
    PART = "part"
    PART_EDGE = "part-edge"
    SLUG = "slug"
    SLUG_EDGE = "slug-edge"
    IDEAL = "ideal"
    ACTUAL = "actual"
    ACTUAL_PALE = "actual-pale"
    STEPS = "steps"
    STEPS_PALE = "steps-pale"
    CONTOUR = "contour"
    TOP = "top"
    BOTTOM = "bottom"
    DRAWING = "drawing"
    OVERCUT = "overcut"
    LEFT_OVER = "left-over"
    JUMP = "jump"
    START = "start"
    END = "end"
    PAUSE = "pause"
    SIZE = "size"
    ERROR = "error"
    WARNING = "warning"
    BAND = "band"
    BAND_EDGE = "band-edge"
    X = "x"
    X_PALE = "x-pale"
    Y = "y"
    Y_PALE = "y-pale"
    CCW = "ccw"
    CCW_PALE = "ccw-pale"
    CW = "cw"
    CW_PALE = "cw-pale"


OF_LEANS: Final = frozenset({Paint.TOP, Paint.BOTTOM})
"""Paints of a wire that leans: pages of upright ones say nothing of them."""
Theme = Mapping[Paint, Colour]
ThemeName = Literal["light", "dark"]

LIGHT: Final[Theme] = {
    Paint.PAGE: (255, 255, 255),
    Paint.INK: (26, 26, 26),
    Paint.GREY: (95, 95, 95),
    Paint.FRAME: (150, 150, 150),
    Paint.GRID: (232, 232, 232),
    Paint.WORK: (248, 243, 230),
    Paint.WORK_EDGE: (176, 158, 116),
    Paint.CLAMP: (226, 226, 226),
    Paint.CLAMP_EDGE: (130, 130, 130),
    Paint.KERF: (118, 194, 238),
    Paint.LEAD: (194, 214, 226),
    Paint.TRIM_1: (246, 190, 96),
    Paint.TRIM_2: (142, 214, 142),
    Paint.TRIM_3: (224, 160, 214),
    Paint.TRIM_4: (236, 226, 110),
    Paint.TRAVEL: (130, 60, 0),
    Paint.PART: (205, 235, 222),
    Paint.PART_EDGE: (0, 138, 101),
    Paint.SLUG: (208, 208, 212),
    Paint.SLUG_EDGE: (120, 120, 120),
    Paint.IDEAL: (26, 26, 26),
    Paint.ACTUAL: (0, 104, 168),
    Paint.ACTUAL_PALE: (196, 221, 238),
    Paint.STEPS: (158, 50, 120),
    Paint.STEPS_PALE: (238, 208, 227),
    Paint.CONTOUR: (158, 50, 120),
    Paint.TOP: (92, 60, 190),
    Paint.BOTTOM: (122, 82, 0),
    Paint.DRAWING: (74, 106, 20),
    Paint.OVERCUT: (214, 40, 40),
    Paint.LEFT_OVER: (20, 80, 200),
    Paint.JUMP: (213, 94, 0),
    Paint.START: (0, 138, 101),
    Paint.END: (158, 50, 120),
    Paint.PAUSE: (160, 102, 0),
    Paint.SIZE: (70, 70, 150),
    Paint.ERROR: (190, 20, 30),
    Paint.WARNING: (160, 102, 0),
    Paint.BAND: (226, 240, 232),
    Paint.BAND_EDGE: (0, 138, 101),
    Paint.X: (0, 104, 168),
    Paint.X_PALE: (196, 221, 238),
    Paint.Y: (213, 94, 0),
    Paint.Y_PALE: (250, 218, 192),
    Paint.CCW: (0, 104, 168),
    Paint.CCW_PALE: (196, 221, 238),
    Paint.CW: (213, 94, 0),
    Paint.CW_PALE: (250, 218, 192),
}

DARK: Final[Theme] = {
    Paint.PAGE: (22, 24, 28),
    Paint.INK: (236, 236, 236),
    Paint.GREY: (172, 176, 182),
    Paint.FRAME: (104, 108, 116),
    Paint.GRID: (46, 49, 56),
    Paint.WORK: (44, 41, 34),
    Paint.WORK_EDGE: (150, 134, 98),
    Paint.CLAMP: (58, 60, 64),
    Paint.CLAMP_EDGE: (150, 152, 158),
    Paint.KERF: (32, 112, 160),
    Paint.LEAD: (58, 80, 94),
    Paint.TRIM_1: (154, 88, 16),
    Paint.TRIM_2: (34, 116, 58),
    Paint.TRIM_3: (136, 62, 124),
    Paint.TRIM_4: (116, 108, 24),
    Paint.TRAVEL: (226, 170, 110),
    Paint.PART: (28, 66, 54),
    Paint.PART_EDGE: (70, 200, 160),
    Paint.SLUG: (70, 72, 78),
    Paint.SLUG_EDGE: (160, 162, 168),
    Paint.IDEAL: (240, 240, 240),
    Paint.ACTUAL: (102, 190, 244),
    Paint.ACTUAL_PALE: (26, 66, 92),
    Paint.STEPS: (230, 150, 205),
    Paint.STEPS_PALE: (92, 48, 78),
    Paint.CONTOUR: (230, 150, 205),
    Paint.TOP: (178, 156, 255),
    Paint.BOTTOM: (222, 184, 96),
    Paint.DRAWING: (170, 210, 96),
    Paint.OVERCUT: (255, 92, 84),
    Paint.LEFT_OVER: (92, 140, 255),
    Paint.JUMP: (250, 150, 60),
    Paint.START: (70, 200, 160),
    Paint.END: (230, 150, 205),
    Paint.PAUSE: (240, 190, 70),
    Paint.SIZE: (170, 170, 245),
    Paint.ERROR: (255, 110, 110),
    Paint.WARNING: (240, 190, 70),
    Paint.BAND: (30, 52, 44),
    Paint.BAND_EDGE: (70, 200, 160),
    Paint.X: (102, 190, 244),
    Paint.X_PALE: (26, 66, 92),
    Paint.Y: (250, 150, 60),
    Paint.Y_PALE: (92, 56, 26),
    Paint.CCW: (102, 190, 244),
    Paint.CCW_PALE: (26, 66, 92),
    Paint.CW: (250, 150, 60),
    Paint.CW_PALE: (92, 56, 26),
}

THEMES: Final[Mapping[ThemeName, Theme]] = {"light": LIGHT, "dark": DARK}


def hexadecimal(colour: Colour) -> str:
    """A colour as pages write it, such as ``#76c2ee``."""
    red, green, blue = colour
    return f"#{red:02x}{green:02x}{blue:02x}"


TONES: Final = (Paint.KERF, Paint.TRIM_1, Paint.TRIM_2, Paint.TRIM_3, Paint.TRIM_4)
"""A rough cut and four trims; the passes after them have the last tone too."""


PASS_DASHES: Final = (None, (16.0, 5.0), (8.0, 5.0), (4.0, 4.0), (1.5, 4.0))
"""Dashes and gaps of the lines of the same passes, so that they are told apart without colours; none of rough cuts."""


class Tone(NamedTuple):
    """A tone, and the passes that have it."""

    paint: Paint
    name: Bilingual


def tone_number(number: int) -> int:
    """The first of the passes, by their numbers from 1, that have the tone of a pass."""
    return min(number, len(TONES))


def paint_of_pass(number: int) -> Paint:
    """Tone of a pass, by its number from 1."""
    return TONES[tone_number(number) - 1]


def tones_of(passes: Iterable[Pass]) -> list[Tone]:
    """Tones of some passes, each once."""
    numbers = {pass_.number for pass_ in passes}
    later = max(numbers, default=0) > len(TONES)
    return [
        Tone(
            paint_of_pass(number),
            bilingual("phrases.passes-from" if later and number == len(TONES) else "phrases.one-pass", number=number),
        )
        for number in sorted(set(map(tone_number, numbers)))
    ]
