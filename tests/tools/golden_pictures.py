"""Golden pictures: what a picture must look like, within a tolerance; ``make golden`` renews those that no longer fit.

A picture that does not fit leaves itself, the golden one and their difference in ``tests/failures``.
"""

import io
import os
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import pytest
from PIL import Image, ImageChops, ImageStat
from places import ROOT

if TYPE_CHECKING:
    from playwright.sync_api import Page

GOLDEN = ROOT / "tests" / "golden"
FAILURES = ROOT / "tests" / "failures"
RENEW = os.environ.get("DRYCUT_RENEW_GOLDEN") == "1"


class Tolerance(NamedTuple):
    """Mean and most difference in grey levels of 255, of pictures made smaller by a whole factor."""

    mean: float
    most: int
    smaller: int = 1


DRAWN = Tolerance(mean=0.1, most=64)
"""A line that is one pixel off is far beyond it, another smoothing of text is not."""

SCREEN = Tolerance(mean=2.0, most=160, smaller=3)
"""Another release of the browser smooths and spaces text otherwise: of nine pixels in one, little of that is left."""


def assert_golden(image: Image.Image, name: str, tolerance: Tolerance = DRAWN) -> None:
    """Fail where a picture in RGB is not the golden one of this name, ``cut.png``; renew that one where it is asked."""
    if RENEW and unlike(image, GOLDEN / name, tolerance):
        GOLDEN.mkdir(exist_ok=True)
        image.save(GOLDEN / name, optimize=True)
    verdict = compare(image, name, FAILURES, tolerance)
    if verdict:
        pytest.fail(f"{name} {verdict}; look at tests/failures, then `make golden` if the new one is right")


def assert_golden_screen(page: "Page", name: str) -> None:
    """The same of what a page shows; open it with ``shipped_font`` for text that is the same on every machine."""
    assert_golden(screen(page), name, SCREEN)


def screen(page: "Page") -> Image.Image:
    """What a page shows, without a blinking caret."""
    shot = page.screenshot(animations="disabled", caret="hide", scale="css")
    return Image.open(io.BytesIO(shot)).convert("RGB")


def compare(actual: Image.Image, name: str, failures: Path, tolerance: Tolerance = DRAWN) -> str:
    """Why a picture is not the golden one, empty where it is; leaves the pictures to look at in `failures`."""
    verdict = unlike(actual, GOLDEN / name, tolerance)
    if verdict:
        failures.mkdir(exist_ok=True)
        for kind, image in pictures_of(actual, GOLDEN / name).items():
            image.save(failures / f"{Path(name).stem}-{kind}.png")
    return verdict


def unlike(actual: Image.Image, golden: Path, tolerance: Tolerance) -> str:
    """In what a picture differs from the file, empty where it does not."""
    expected = read(golden)
    if expected is None:
        return "has no golden picture"
    if actual.size != expected.size:
        return f"has size {actual.size}, expected {expected.size}"
    apart = difference(actual.reduce(tolerance.smaller), expected.reduce(tolerance.smaller))
    mean, most = ImageStat.Stat(apart).mean[0], apart.getextrema()[1]
    fine = mean <= tolerance.mean and most <= tolerance.most
    return "" if fine else f"differs by {mean:.3f} grey levels in the mean, {most} at most"


def read(golden: Path) -> Image.Image | None:
    """The golden picture, None where there is none yet."""
    if not golden.exists():
        return None
    with Image.open(golden) as image:
        return image.convert("RGB")


def difference(actual: Image.Image, expected: Image.Image) -> Image.Image:
    """Of each pixel, how far its most changed colour is off, in grey levels."""
    red, green, blue = ImageChops.difference(actual, expected).split()
    return ImageChops.lighter(ImageChops.lighter(red, green), blue)


def pictures_of(actual: Image.Image, golden: Path) -> dict[str, Image.Image]:
    """What there is to look at; the difference only where the pictures have one size."""
    expected = read(golden)
    if expected is None:
        return {"actual": actual}
    pictures = {"actual": actual, "expected": expected}
    return pictures | ({"difference": difference(actual, expected)} if actual.size == expected.size else {})
