"""Widths of texts without a font: those that the font itself has, and that pygame writes."""

import json
import subprocess
import sys

import pygame.font
import pytest
from font_metrics import metrics_of, text_of

from sim.show.draw.letters import METRICS, text_width
from sim.show.draw.style import FONT

TEXTS = (
    "AVA To. WAVE y = 1",
    "deviation −1.27 µm, block 12 of 340",
    "kerf 0.200 mm as programmed",
    "The wire leaves the workpiece: 3B517",
    "程序段 12：偏差 0.5 µm（丝径 0.18 mm）",
    "需要核对，第 3 行第 5 列",
)


def test_the_stored_metrics_are_those_of_the_font() -> None:
    metrics = metrics_of(FONT)
    assert json.loads(METRICS.read_text("utf-8")) == metrics
    assert METRICS.read_text("utf-8") == text_of(metrics)


@pytest.mark.parametrize("text", TEXTS)
def test_a_text_is_as_wide_as_it_is_written_large(text: str) -> None:
    """A thousand pixels tall, where the font's rounding to whole pixels is a thousandth of a letter."""
    pygame.font.init()
    written = pygame.font.Font(FONT, 1000).size(text)[0]
    assert text_width(text, 1000.0) == pytest.approx(written, abs=0.005 * written)


def test_kerning_draws_letters_together_and_a_letter_that_the_font_has_not_is_as_wide_as_most() -> None:
    assert text_width("AV", 24.0) < text_width("A", 24.0) + text_width("V", 24.0)
    assert text_width("\N{PILE OF POO}", 24.0) == 24.0
    assert text_width("", 24.0) == 0.0


def test_no_picture_of_a_path_in_lines_loads_pygame_pillow_or_shapely() -> None:
    code = (
        "import sys; import sim.show.pictures.cut.of_path, sim.show.pictures.files;"
        "from sim.show.draw.sheet import drawing; drawing(800);"
        "print([name for name in ('pygame', 'PIL', 'shapely', 'numba') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
