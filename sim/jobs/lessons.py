"""A lesson written for who learns: one page, and a package for learning platforms; examples to begin with."""

import io
import zipfile
from pathlib import Path
from typing import Final
from xml.sax.saxutils import escape, quoteattr

from parser.files import read_bytes
from sim.base.files import staged
from sim.make.lessons import ReadyLesson, ready_lesson
from sim.show.lesson_page import lesson_page
from sim.show.lesson_page.page import lesson_entry
from sim.teach.lesson import Lesson, load_lesson

_EXAMPLES: Final = Path(__file__).parents[1] / "teach" / "lessons"
_FILE: Final = "lesson.toml"
_PAGE: Final = "lesson.html"
_DATE: Final = (2020, 1, 1, 0, 0, 0)
"""Of files in a package: the same lesson gives the same bytes."""


def lesson_of(path: Path) -> ReadyLesson:
    """The lesson of a file, made ready. DrycutError where it, or a file that it names, is wrong."""
    return ready_lesson(load_lesson(path), path)


def lesson_into(ready: ReadyLesson, output: Path, scorm: Path | None) -> int:
    """Write the page of a lesson, and its package where one is wanted; how long the page is, bytes."""
    page = lesson_page(ready).encode()
    with staged(output.parent, [output.name]) as stage:
        (stage / output.name).write_bytes(page)
    if scorm is not None:
        with staged(scorm.parent, [scorm.name]) as stage:
            (stage / scorm.name).write_bytes(package_of(ready, page))
    return len(page)


def package_of(ready: ReadyLesson, page: bytes) -> bytes:
    """A SCORM 1.2 package of one unit: the page, and the manifest that names it."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as package:
        for name, data in (("imsmanifest.xml", _manifest(ready).encode()), (_PAGE, page)):
            info = zipfile.ZipInfo(name, _DATE)
            info.compress_type = zipfile.ZIP_DEFLATED
            package.writestr(info, data)
    return out.getvalue()


def _manifest(ready: ReadyLesson) -> str:
    """``imsmanifest.xml`` (SCORM 1.2 content aggregation model, section 2.3)."""
    lesson, digest = ready.lesson, lesson_entry(ready)["lesson"]
    title = lesson.title.zh if lesson.title.zh == lesson.title.en else f"{lesson.title.zh} / {lesson.title.en}"
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<manifest identifier={quoteattr(f"drycut-{digest}")} version="1.2"
  xmlns="http://www.imsproject.org/xsd/imscp_rootv1p1p2"
  xmlns:adlcp="http://www.adlnet.org/xsd/adlcp_rootv1p2">
  <metadata><schema>ADL SCORM</schema><schemaversion>1.2</schemaversion></metadata>
  <organizations default="drycut">
    <organization identifier="drycut">
      <title>{escape(title)}</title>
      <item identifier="lesson" identifierref="page"><title>{escape(title)}</title></item>
    </organization>
  </organizations>
  <resources>
    <resource identifier="page" type="webcontent" adlcp:scormtype="sco" href="{_PAGE}"><file href="{_PAGE}"/></resource>
  </resources>
</manifest>
"""


def lesson_names() -> tuple[str, ...]:
    """Names of the lessons that come with drycut, in the order in which they are taught."""
    return tuple(sorted(folder.parent.name for folder in _EXAMPLES.glob(f"*/{_FILE}")))


def example_lesson(name: str) -> Lesson:
    """A lesson that comes with drycut."""
    return load_lesson(_EXAMPLES / name / _FILE)


def lesson_example_into(folder: Path, name: str) -> list[str]:
    """Write the files of a lesson that comes with drycut into a folder, all or none; gives their names."""
    files = sorted(file for file in (_EXAMPLES / name).iterdir() if file.is_file())
    names = [file.name for file in files]
    with staged(folder, names) as stage:
        for file in files:
            (stage / file.name).write_bytes(read_bytes(file))
    return names
