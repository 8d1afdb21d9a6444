"""What every page must offer anyone: names for a screen reader, contrast, the keyboard, a narrow screen."""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

if TYPE_CHECKING:
    from playwright.sync_api import JSHandle, Page

LEAST_CONTRAST, LEAST_CONTRAST_LARGE = 4.5, 3.0
"""WCAG 2.2, success criterion 1.4.3; large is from 24 px, or 18.66 px and bold."""

SCREENS = 20
"""A page longer than so many windows is looked at in so many places."""

PHONE = {"width": 390, "height": 844}
NO_TEXT = """
* { color: transparent !important; -webkit-text-fill-color: transparent !important; text-shadow: none !important }
svg text, svg text * { fill: transparent !important }
"""


_DRAWN = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(null))))"
"""A page sees its new size in the frame behind a change, and draws for it in the next one."""


def complaints(page: "Page") -> list[str]:
    """All that is wrong with a page as it stands; empty where all is well."""
    return [*untitled(page), *unnamed(page), *doubled_ids(page), *faint(page), *unreached(page), *too_wide(page)]


def untitled(page: "Page") -> list[str]:
    """Whether the document says what it is and in what language."""
    language, title = page.evaluate("[document.documentElement.lang, document.title.trim()]")
    return [f"the document has no {what}" for what, value in (("language", language), ("title", title)) if not value]


def unnamed(page: "Page") -> list[str]:
    """Controls and pictures that a screen reader has no name for."""
    return [f"no name: {tag}" for tag in _told(page, "unnamed")]


def doubled_ids(page: "Page") -> list[str]:
    """Ids that stand for several elements."""
    return [f"id twice: {name}" for name in _told(page, "doubledIds")]


def too_wide(page: "Page") -> list[str]:
    """What must be scrolled sideways on a phone."""
    before = page.viewport_size
    page.set_viewport_size(PHONE)
    page.evaluate(_DRAWN)
    found = [f"sticks out at {PHONE['width']} px: {what}" for what in _told(page, "tooWide")]
    if before:
        page.set_viewport_size(before)
    return found


def unreached(page: "Page") -> list[str]:
    """Controls that no tab stop leads to, and such where the focus does not show."""
    about = _about(page)
    controls = about.evaluate_handle("about => about.controls()")
    count = controls.evaluate("controls => controls.length")
    met = dict(_stops(page, about, controls, count + 2))
    groups = controls.evaluate("(controls, about) => controls.map(about.group)", about)
    reached = {groups[at] for at in met if groups[at]}
    tags = controls.evaluate("(controls, about) => controls.map(about.tag)", about)
    missing = [at for at in range(count) if at not in met and groups[at] not in reached]
    unseen = [at for at, seen in met.items() if not seen]
    return [*(f"no tab stop: {tags[at]}" for at in missing), *(f"focus does not show: {tags[at]}" for at in unseen)]


def faint(page: "Page") -> list[str]:
    """Texts with too little contrast against what is really drawn behind them."""
    found = {}
    told = [_told(page, "texts") for _ in _places(page)]
    with _no_text(page):
        shots = [page.screenshot(animations="disabled", scale="css") for _ in _places(page)]
    for texts, shot in zip(told, shots, strict=True):
        behind = np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"), dtype=float)
        for text in texts:
            least = LEAST_CONTRAST_LARGE if text["large"] else LEAST_CONTRAST
            seen = min(_contrast(text, behind[_pixels(box)].reshape(-1, 3)) for box in text["boxes"])
            if seen < least:
                found[f"contrast {seen:.2f} of {least}: {text['text']!r}"] = None
    return list(found)


@contextmanager
def _no_text(page: "Page") -> Iterator[None]:
    """A page without its letters: for all of its windows at once, as it takes long to draw another page each time."""
    page.evaluate(
        "(style) => { const sheet = new CSSStyleSheet(); sheet.replaceSync(style);"
        " document.adoptedStyleSheets.push(sheet); }",
        NO_TEXT,
    )
    yield
    page.evaluate("() => { document.adoptedStyleSheets.pop(); }")


def _contrast(text: dict, behind: np.ndarray) -> float:
    """Median contrast of a text over (n, 3) pixels: WCAG's (L1 + 0.05)/(L2 + 0.05) of relative luminances."""
    colour = text["alpha"] * np.array(text["colour"]) + (1 - text["alpha"]) * behind
    ink, paper = _luminance(colour), _luminance(behind)
    return float(np.median((np.maximum(ink, paper) + 0.05) / (np.minimum(ink, paper) + 0.05)))


def _luminance(colour: np.ndarray) -> np.ndarray:
    """Relative luminance as WCAG 2.2 defines it, 0 black to 1 white, of sRGB levels (n, 3)."""
    level = colour / 255
    linear = np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)
    return linear @ np.array([0.2126, 0.7152, 0.0722])


def _pixels(box: list[float]) -> tuple[slice, slice]:
    left, top, right, bottom = map(round, box)
    return slice(top, bottom), slice(left, right)


def _places(page: "Page") -> Iterator[None]:
    """Scroll through the page window by window, and back to where it was."""
    before, height, window = page.evaluate("[scrollY, document.scrollingElement.scrollHeight, innerHeight]")
    last = max(height - window, 0)
    for top in np.linspace(0, last, min(1 + -(-last // window), SCREENS)):
        page.evaluate("top => scrollTo({ top, behavior: 'instant' })", float(top))
        yield
    page.evaluate("top => scrollTo({ top, behavior: 'instant' })", before)


def _stops(page: "Page", about: "JSHandle", controls: "JSHandle", presses: int) -> Iterator[tuple[int, bool]]:
    """Which control each press of the tab key leads to, and whether its focus shows."""
    page.evaluate("document.activeElement.blur()")
    for _ in range(presses):
        page.keyboard.press("Tab")
        at, seen = controls.evaluate("(controls, about) => about.focused(controls)", about)
        if at >= 0:
            yield at, seen


def _told(page: "Page", what: str) -> list:
    return _about(page).evaluate(f"about => about.{what}()")


def _about(page: "Page") -> "JSHandle":
    return page.evaluate_handle(_script())


@cache
def _script() -> str:
    return Path(__file__).with_name("page_checks.js").read_text("utf-8")
