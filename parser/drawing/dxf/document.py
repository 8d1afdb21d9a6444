"""The bytes of a DXF file to the document that ezdxf makes of them, damaged files through its recover mode.

Subclass marks for entities that are bare group codes, as ezdxf asks for them.

Releases since R13 divide the group codes of an entity by marks, group code 100, such as ``AcDbSpline``. Small programs
write the codes alone, often the ENTITIES section alone, and whoever reads by codes needs no marks. ezdxf needs them for
some kinds of entities, and refuses the whole file where one of these has none.

Linetypes that are broken: centre lines, hidden edges and the like, which are no contours.
"""

import io
import logging
import re
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from ezdxf import recover
from ezdxf.document import Drawing as Document
from ezdxf.entities.ltype import Linetype
from ezdxf.filemanagement import dxf_stream_info
from ezdxf.lldxf.encoding import decode_dxf_unicode
from ezdxf.lldxf.tagger import binary_tags_loader

from parser.files import kind_of
from parser.findings.catalogue import LANGUAGES, Bilingual, Remark, term
from parser.findings.errors import DrawingError
from parser.text.encoding import printable

# Kinds that ezdxf 1.4 does not load bare, with the mark of each as the DXF reference has it.
_MARKS = {
    b"SPLINE": b"AcDbSpline",
    b"HELIX": b"AcDbSpline",
    b"LWPOLYLINE": b"AcDbPolyline",
    b"MTEXT": b"AcDbMText",
    b"HATCH": b"AcDbHatch",
    b"LEADER": b"AcDbLeader",
    b"MULTILEADER": b"AcDbMLeader",
    b"MLEADER": b"AcDbMLeader",
    b"3DSOLID": b"AcDbModelerGeometry",
    b"BODY": b"AcDbModelerGeometry",
    b"REGION": b"AcDbModelerGeometry",
}
# Group codes that all entities have, by the DXF reference; their subclass has none of them.
_COMMON = frozenset(b"5 6 8 48 60 62 67 102 284 330 347 360 370 390".split())
_EXTENDED = 1000  # group codes from here on belong to other programs and stand last


def with_marks(data: bytes) -> bytes:
    """The text of a DXF file with a marked subclass for each bare entity; the same object where none wants any.

    The subclass repeats the codes that the entity has: of releases before R13, ezdxf reads some of them before the mark
    and some behind it.
    """
    lines = data.split(b"\n")
    parts: list[bytes] = []
    last = 0
    for bare in _bare(lines):
        codes = range(bare.first, bare.past, 2)
        own = [line for at in codes if lines[at].strip() not in _COMMON for line in lines[at : at + 2]]
        parts += [*lines[last : bare.past], b"100", b"AcDbEntity", b"100", bare.mark, *own]
        last = bare.past
    return b"\n".join([*parts, *lines[last:]]) if parts else data


class _Bare(NamedTuple):
    """Lines of an entity's group codes, from the first one behind its name to the last one of its own, and its mark."""

    first: int
    past: int
    mark: bytes


def _bare(lines: list[bytes]) -> Iterator[_Bare]:
    """Entities that want marks, in file order."""
    mark, first, past = None, 0, 0
    for at in range(0, len(lines) - 1, 2):
        code = lines[at].strip()
        if code == b"0":
            if mark:
                yield _Bare(first, past, mark)
            mark, first, past = _MARKS.get(lines[at + 1].strip()), at + 2, at + 2
        elif code == b"100":
            mark = None
        elif mark and past == at and not (len(code) == 4 and code.isdigit() and int(code) >= _EXTENDED):
            past = at + 2
    if mark:
        yield _Bare(first, past, mark)


_BINARY = b"AutoCAD Binary DXF\r\n\x1a\x00"
_SECTION = re.compile(rb"(?:^|[\r\n])[ \t]*0[ \t]*[\r\n]+[ \t]*SECTION")
_END = re.compile(rb"(?:^|[\r\n])[ \t]*0[ \t]*[\r\n]+[ \t]*EOF[\s\0\x1a]*$")
_UNITS = "$INSUNITS"
# An entity of a text begins with the group code 0, on a line of its own, and its name on the next.
_ENTITY = re.compile(rb"(?:^|[\r\n])[ \t]*+0[ \t]*+[\r\n]++[ \t]*+[A-Z_]")
MOST_ENTITIES = 200_000
"""Entities in a file, and entities that stand in the drawing once its blocks are inserted: no part has more."""
_MOST_FAULTS = 5  # kinds named one by one
_LONGEST = 120  # characters of a foreign message

logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # what it finds stands in the notes, not on stderr


def read_document(path: Path, data: bytes) -> tuple[Document, list[Remark]]:
    """The document of the bytes of a file, and notes on what was mended.

    Raises DrawingError where it is no DXF or beyond mending.
    """
    document, notes = _loaded(path, data)
    if _UNITS.encode() not in data:
        document.header[_UNITS] = 0  # ezdxf takes a file that names no unit for one in metres
    return document, notes


def _loaded(path: Path, data: bytes) -> tuple[Document, list[Remark]]:
    if not data.strip():
        raise DrawingError("drawing-empty", path=path)
    if data.startswith(_BINARY):
        return _binary(path, data), []
    _refuse_too_many(path, _ENTITY.finditer(data))
    if not _SECTION.search(data):
        kind = kind_of(data)
        found = Bilingual(*(term(kind, language) for language in LANGUAGES)) if kind else ""
        raise DrawingError("no-dxf", path=path, kind=found)
    if _END.search(data[-4096:]):
        early = []
    else:
        data, early = _ended(data), [Remark("ends-early")]
    try:
        return _text(data), early
    except Exception:  # damaged files end in any error
        return _mended(path, data, early)


def _mended(path: Path, data: bytes, early: list[Remark]) -> tuple[Document, list[Remark]]:
    """The document of data that ezdxf refuses: whole but for its subclass marks, or damaged."""
    marked = with_marks(data)
    if marked is not data:
        try:
            return _text(marked), early
        except Exception:
            data = marked
    document, mended = _recovered(path, data)
    return document, early + mended


def _ended(data: bytes) -> bytes:
    """The data up to the last entity, which may be half of one, and an end behind it: recover mode asks for one."""
    lines = data.split(b"\n")
    last = max((at for at in range(0, len(lines), 2) if lines[at].strip() == b"0"), default=0)
    return b"\n".join([*lines[:last], b"0", b"ENDSEC", b"0", b"EOF", b""])


def _refuse_too_many(path: Path, entities: Iterable[object]) -> None:
    """DrawingError for more entities than are read, before the library makes an object of each."""
    if next(islice(entities, MOST_ENTITIES, None), None) is not None:
        raise DrawingError("too-many-entities", path=path, most=MOST_ENTITIES)


def _binary(path: Path, data: bytes) -> Document:
    try:
        _refuse_too_many(path, (tag for tag in binary_tags_loader(data) if tag[0] == 0))
        return Document.load(binary_tags_loader(data))
    except DrawingError:
        raise
    except Exception as error:
        raise _beyond_mending(path, error) from None


def _text(data: bytes) -> Document:
    encoding = dxf_stream_info(io.StringIO(data.decode("utf-8", errors="ignore"))).encoding
    text = data.decode(encoding, errors="surrogateescape")
    # Releases before R2007 write what their code page lacks as \U+ and four digits; ezdxf leaves it as it is.
    return Document.read(io.StringIO(decode_dxf_unicode(text), newline=None))


def _recovered(path: Path, data: bytes) -> tuple[Document, list[Remark]]:
    try:
        document, audit = recover.read(io.BytesIO(data))
        document.modelspace()
    except Exception as error:
        raise _beyond_mending(path, error) from None
    faults = Counter(_foreign(fault.message) for fault in (*audit.errors, *audit.fixes))
    named = "; ".join(
        f"{text} ({times} times)" if times > 1 else text for text, times in faults.most_common(_MOST_FAULTS)
    )
    return document, [Remark("recovered-from", {"faults": named}) if named else Remark("recovered")]


def _beyond_mending(path: Path, error: Exception) -> DrawingError:
    return DrawingError("drawing-beyond-mending", path=path, why=_foreign(str(error)) or type(error).__name__)


def _foreign(message: str) -> str:
    """A message of the library on one line, cut to a length that people read."""
    line = printable(" ".join(message.split())).rstrip(".")
    return line if len(line) <= _LONGEST else f"{line[: _LONGEST - 1]}…"


_ELEMENT = 49  # group code of a dash, above 0, or a gap, below 0


class Linetypes:
    """Which of the linetypes of a document are broken, by their names in small letters."""

    def __init__(self, document: Document) -> None:
        self._broken = {entry.dxf.name.lower(): _has_gaps(entry) for entry in document.linetypes}

    def is_broken(self, name: str) -> bool:
        """Whether lines of this type have gaps; by the name alone where the document does not say what it is."""
        if name not in self._broken:
            self._broken[name] = _sounds_broken(name)
        return self._broken[name]


def _has_gaps(entry: Linetype) -> bool:
    return any(code == _ELEMENT and value < 0.0 for code, value in entry.pattern_tags.tags)


def _sounds_broken(name: str) -> bool:
    names = _names()
    return any(part in name for part in names["broken"]) and not any(part in name for part in names["whole"])


@cache
def _names() -> dict[str, list[str]]:
    return tomllib.loads(Path(__file__).with_name("linetypes.toml").read_text(encoding="utf-8"))
