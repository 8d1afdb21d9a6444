"""Pictures of a run as files, all of them or none."""

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from PIL import Image, ImageOps

from parser.findings.catalogue import Language
from parser.findings.errors import SettingsError
from sim.files import staged
from sim.run.recording import Recording
from sim.show.draw.paints import THEMES, Theme, ThemeName
from sim.show.draw.sheet import drawing, pixels
from sim.show.pictures.gallery import PICTURES, Subject, label, subject_of

Look = tuple[Theme, Language]
DPI = 300
"""At which the named sizes are paper sizes."""


class Asked(NamedTuple):
    """Pictures that are asked for, and the files that they become, ``.png`` or ``.svg``, in a folder."""

    folder: Path
    files: Mapping[str, str]


def write_pictures(
    recording: Recording, asked: Asked, width_px: int, theme: ThemeName, language: Language
) -> list[Path]:
    """Draw pictures and write them; the files written.

    A picture of what the run has not is left out. Raises SettingsError where none is left, FileUnreadableError where
    the folder cannot be written; nothing is written then, and no older file taken away.
    """
    subject = subject_of(recording)
    look = (THEMES[theme], language)
    drawn: list[str] = []
    with staged(asked.folder, list(asked.files.values())) as stage:
        for name, file in asked.files.items():
            to_svg = file.lower().endswith(".svg")
            if (_write_svg if to_svg else _write_pixels)(stage / file, name, subject, width_px, look):
                drawn.append(file)
        if not drawn:
            raise SettingsError(f"{', '.join(asked.files)}: this program has nothing to show there; nothing written")
    return [asked.folder / file for file in drawn]


def _write_svg(file: Path, name: str, subject: Subject, width_px: int, look: Look) -> bool:
    """Write a picture as SVG; False where there is none."""
    svg = PICTURES[name].draw(drawing(_drawn_px(name, width_px), *look), subject)
    if svg is not None:
        file.write_text(svg.document(label(name, subject, look[1]), width_px), encoding="utf-8")
    return svg is not None


def _write_pixels(file: Path, name: str, subject: Subject, width_px: int, look: Look) -> bool:
    """Write a picture as PNG; False where there is none."""
    raster = PICTURES[name].draw(pixels(_drawn_px(name, width_px), *look), subject)
    if raster is not None:
        image = ImageOps.contain(raster.image(), (width_px, raster.height_px), Image.Resampling.LANCZOS)
        image.save(file, format="png", dpi=(DPI, DPI))
    return raster is not None


def _drawn_px(name: str, width_px: int) -> int:
    """Width that a picture is drawn in, before it is made smaller."""
    return max(width_px, PICTURES[name].least_px)
