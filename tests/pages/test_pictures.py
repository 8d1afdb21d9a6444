"""Pictures as SVG in a browser are the pictures of pixels."""

import numpy as np
import pytest
from browser import OpenPage
from everything import everything
from golden_pictures import screen

from sim.show.draw.sheet import drawing, pixels
from sim.show.draw.style import DARK, LIGHT, Theme


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_svg_and_pixels_show_the_same(theme: Theme, open_page: OpenPage) -> None:
    raster, svg = pixels(160, theme).page(120), drawing(160, theme).page(120)
    everything(raster)
    everything(svg)
    html = f'<!doctype html><html lang="en"><title>x</title><body style="margin:0">{svg.fragment("x")}</body></html>'
    shown = np.asarray(screen(open_page(html, 160, 120, shipped_font=True).page).convert("RGB"), dtype=float)
    drawn = np.asarray(raster.image(), dtype=float)
    assert shown.shape == drawn.shape
    apart = np.abs(shown - drawn).max(axis=2)
    assert apart.mean() < 4.0, "grey levels of 255: edges are smoothed otherwise"
    assert (apart > 96.0).mean() < 0.01, "no line or area is missing or beside its place"
