"""Pictures as files, all of them or none, and what they are drawn of: a program alone, or a run of it."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, Protocol

from parser.findings.catalogue import Language
from parser.findings.errors import SettingsError
from sim.base.files import staged
from sim.show.draw.sheet import AnyCanvas, Sheet, drawing, pixels
from sim.show.draw.style import THEMES, ThemeName
from sim.show.draw.svg import Svg
from sim.show.texts import Words

if TYPE_CHECKING:
    from sim.show.draw.raster import Raster


DPI = 300
"""At which the named sizes are paper sizes."""


class Drawable(Protocol):
    """What pictures are drawn of."""

    def title_in(self, language: Language) -> str:
        """What it is called in a language."""

    def least_px(self, name: str) -> int:
        """How narrow a picture can be."""

    def draw(self, name: str, sheet: Sheet[AnyCanvas]) -> AnyCanvas | None:
        """The page of a picture, drawn; None where there is nothing to show in it."""


def label(name: str, title: str, language: Language) -> str:
    """What a picture is, for those who cannot see it."""
    return f"{title}: {Words(language)(f'common.picture_{name}')}"


class PictureFiles(NamedTuple):
    """Pictures that are asked for, and the files that they become, ``.png`` or ``.svg``, in a folder."""

    folder: Path
    files: Mapping[str, str]


def write_pictures(
    drawable: Drawable, picture_files: PictureFiles, width_px: int, theme: ThemeName, language: Language
) -> list[Path]:
    """Draw pictures and write them; the files written.

    A picture with nothing to show is left out. Raises SettingsError where none is left, FileUnreadableError where the
    folder cannot be written; nothing is written then, and no older file taken away.
    """
    drawn: list[str] = []
    with staged(picture_files.folder, list(picture_files.files.values())) as stage:
        for name, file in picture_files.files.items():
            made = (max(width_px, drawable.least_px(name)), THEMES[theme], language)
            if file.lower().endswith(".svg"):
                written = _write_svg(stage / file, name, drawable, drawing(*made), width_px)
            else:
                written = _write_pixels(stage / file, name, drawable, pixels(*made), width_px)
            drawn += [file] * written
        if not drawn:
            raise SettingsError("nothing-to-draw", pictures=", ".join(picture_files.files))
    return [picture_files.folder / file for file in drawn]


def _write_svg(file: Path, name: str, drawable: Drawable, sheet: Sheet[Svg], width_px: int) -> bool:
    """Write a picture as SVG that is shown `width_px` wide; False where there is none."""
    svg = drawable.draw(name, sheet)
    if svg is not None:
        file.write_text(
            svg.document(label(name, drawable.title_in(sheet.language), sheet.language), width_px), encoding="utf-8"
        )
    return svg is not None


def _write_pixels(file: Path, name: str, drawable: Drawable, sheet: "Sheet[Raster]", width_px: int) -> bool:
    """Write a picture as PNG, made smaller to `width_px` where it is wider; False where there is none."""
    from PIL import Image, ImageOps  # noqa: PLC0415 - SVG needs no pillow

    raster = drawable.draw(name, sheet)
    if raster is not None:
        image = ImageOps.contain(raster.image(), (width_px, raster.height_px), Image.Resampling.LANCZOS)
        image.save(file, format="png", dpi=(DPI, DPI))
    return raster is not None
