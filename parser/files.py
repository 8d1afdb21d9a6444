"""Files as they come in: read up to a limit, and recognised by what they hold; the border is bytes and terms.

The one door by which drycut reads what users give it: files and the standard input, up to a limit.

What a file is that is no program, by what it holds and never by its name: asked only where no block can be read.
"""

import os
import re
import stat
import sys
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import BinaryIO

from parser.findings.errors import FileUnreadableError, SettingsError, system_message

MOST_MB = 64
"""Size of a file that is read, MB of 10^6 bytes: 3B of two million blocks, DXF of some hundred thousand entities."""
LIMIT_NAME = "DRYCUT_MAX_FILE_MB"
"""Environment variable that sets another limit, in MB."""

_BYTES_PER_MB = 1_000_000
_HIGHEST_MB = 1_000_000
_CHUNK = 1 << 20  # a file may grow while it is read, and files of /proc tell no size
# A pipe must not be waited for. Not every system knows all of these.
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0) | getattr(os, "O_BINARY", 0)
_KINDS = {
    stat.S_IFDIR: "is-a-folder",
    stat.S_IFIFO: "is-a-pipe",
    stat.S_IFSOCK: "is-a-socket",
    stat.S_IFCHR: "is-a-device",
    stat.S_IFBLK: "is-a-device",
}


def read_bytes(path: Path) -> bytes:
    """Bytes of a regular file of no more than the limit.

    Raises FileUnreadableError for any other file, without reading it, and where it cannot be opened.
    """
    try:
        _refuse_other_than_file(path, path.stat())  # before it is opened: that alone makes some devices do something
        with os.fdopen(os.open(path, _FLAGS), "rb") as file:
            found = os.fstat(file.fileno())
            _refuse_other_than_file(path, found)
            return _up_to_limit(path, file, found.st_size)
    except FileUnreadableError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise FileUnreadableError("cannot-be-read", file=path, why=system_message(error)) from None


def read_text(path: Path) -> str:
    """Text of a file in UTF-8, line ends as they are. As `read_bytes`; UnicodeDecodeError where it is no such text."""
    return read_bytes(path).decode("utf-8")


def read_stdin() -> bytes:
    """All of the standard input. FileUnreadableError where it is closed, or longer than the limit."""
    if sys.stdin is None:
        raise FileUnreadableError("stdin-closed")
    return _up_to_limit("<stdin>", sys.stdin.buffer, 0)


def limit_mb() -> float:
    """Limit on the size of a file, MB. SettingsError where the environment gives one that is none."""
    setting = os.environ.get(LIMIT_NAME, "")
    if not setting:
        return MOST_MB
    try:
        limit = float(setting)
    except ValueError:
        limit = 0.0
    if not 0.0 < limit <= _HIGHEST_MB:
        raise SettingsError("size-limit-no-number", name=LIMIT_NAME, most_mb=_HIGHEST_MB, found=setting)
    return limit


def _refuse_other_than_file(path: Path, found: os.stat_result) -> None:
    if not stat.S_ISREG(found.st_mode):
        raise _refused(path, _KINDS.get(stat.S_IFMT(found.st_mode), "is-a-device"))


def _up_to_limit(name: Path | str, file: BinaryIO, told_size: int) -> bytes:
    limit = int(limit_mb() * _BYTES_PER_MB)
    parts, left = [], limit + 1
    while told_size <= limit and left and (part := file.read(min(left, _CHUNK))):
        parts.append(part)
        left -= len(part)
    if told_size > limit or not left:
        raise _refused(name, "file-too-large", f"{LIMIT_NAME}={limit_mb():g}")
    return b"".join(parts)


def _refused(name: Path | str, what: str, detail: str = "") -> FileUnreadableError:
    return FileUnreadableError("cannot-be-read-since", file=name, what=what, detail=detail)


PROGRAMS = ("kind-program", "kind-iso")
"""Terms of texts with blocks of 3B or 4B somewhere, and with lines of ISO: what a drawing is not."""
PLOTS = ("kind-hpgl", "kind-svg", "kind-iges", "kind-curve-list")
"""Terms of files that are read as drawings beside DXF."""
HINTS: Mapping[str, str] = MappingProxyType(
    {
        "two-languages": "hint-one-language",
        "kind-dxf": "hint-compare",
        "kind-dwg": "hint-save-dxf",
        "kind-step": "hint-save-dxf",
        **dict.fromkeys(PLOTS, "hint-make-program"),
        "kind-archive": "hint-unpack",
        "kind-office": "hint-plain-text",
        "kind-html": "hint-plain-text",
        "kind-pdf": "hint-plain-text",
        "kind-utf16": "hint-utf8",
        "kind-toml": "hint-scenario",
        "kind-card-log": "hint-replay",
        "is-a-pipe": "hint-stdin",
        "file-too-large": "hint-limit",
        "too-many-blocks": "hint-split",
    }
)
"""Term of the hint for what was found in place of a program, where the usual one does not help."""

_LOOKED_AT = 1 << 16  # bytes: whatever a file is, it says so by then
_HEAD = 1024
_LEAST_LETTERS = 8  # of a text in UTF-16: fewer bytes may be anything

_MAGIC: tuple[tuple[str, bytes], ...] = (
    ("kind-pdf", rb"\s*+%PDF-\d"),
    ("kind-dwg", rb"AC1\.|AC10\d\d|MC0\.0|AC2\.10"),  # its release
    ("kind-dxf", rb"AutoCAD Binary DXF\r\n\x1a\0"),
    ("kind-dxf", rb".*?(?<![^\r\n])[ \t]*+0[ \t]*+[\r\n]++[ \t]*+SECTION[ \t]*+[\r\n]++[ \t]*+2[ \t]*+[\r\n]"),
    ("kind-office", rb"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"),  # a compound file: .doc, .xls
    ("kind-office", rb"PK\x03\x04.{26,512}?(?:\[Content_Types\]\.xml|_rels/|mimetypeapplication/vnd\.)"),
    ("kind-archive", rb"PK\x03\x04|PK\x05\x06|Rar!\x1a\x07|7z\xbc\xaf\x27\x1c|\x1f\x8b\x08|BZh\d1AY|\xfd7zXZ\0"),
    ("kind-picture", rb"\x89PNG\r\n\x1a\n|\xff\xd8\xff|GIF8[79]a|II\*\0|MM\0\*|RIFF.{4}WEBP|BM.{4}\0{4}"),
    ("kind-svg", rb"(?:\xef\xbb\xbf)?\s*+(?:<[?!][^>]*+>\s*+)*+<svg[\s>]"),
    ("kind-html", rb"(?i:(?:\xef\xbb\xbf)?\s*+(?:<!DOCTYPE\s++html|(?:<[?!][^>]*+>\s*+)*+<html[\s>]))"),
    ("kind-executable", rb"\x7fELF|MZ.{0,62}?\0|\xca\xfe\xba\xbe|[\xcf\xce]\xfa\xed\xfe"),
    ("kind-step", rb"\s*+ISO-10303-21;"),
    ("kind-iges", rb"[^\r\n]{72}S[ 0]*+1[ \t]*+[\r\n]"),  # column 73 names the section
    ("kind-card-log", rb"drycut card log"),
    (
        "kind-curve-list",
        rb"(?:\xef\xbb\xbf)?(?:[ \t]*+(?:#[^\r\n]*+|kind\b[^\r\n]*+)?[\r\n]++)*+"
        rb"[ \t]*+(?i:line|arc|circle)[ \t]*+[,;\t]",
    ),
)
"""Kinds by their first bytes, the more certain ones first. Possessive quantifiers keep hostile bytes linear."""

_BLOCK = re.compile(rb"(?i)(?:B\s*+\d*+\s*+){3,4}(?:DD?\s*+)?G\s*+[XY]\s*+(?:DD?\s*+)?(?:L|[NS]\s*+R)\s*+[1-4]")
_NUMBERS_OF_BLOCKS = re.compile(rb"(?i)B[ \t]*+\d*+[ \t]*+B")
_REMARK = re.compile(rb"\([^()\r\n]*+\)|;[^\r\n]*+")
_ISO_LINE = re.compile(rb"(?i)\s*+(?:%.*|/?\s*+(?:[A-Z][ \t]*+[-+]?(?:\d++\.?+\d*+|\.\d++)\s*+)++)")
_ISO_WORD = re.compile(rb"(?i)(?<![A-Z])G[ \t]*+(?:0?[0-3]|4[0-2]|5\d|9[0-2])(?!\d)")
_HPGL = re.compile(
    rb"(?i)\s*+(?:\x1b(?:%-?\d{0,5}[A-Z]|E|\.[@-Z(][\d;]{0,12}:?))*+(?:(?:BP|CO|DF|EC|IN|IP|LA|LT|NP|PA|PC|PD|PE|PM|PR|PS|PU|PW|QL|RO|SC|SP|TR|VS|WU)"
    rb"[-+\d., \t]*+;?\s*+){3}"
)
_PEN = re.compile(rb"(?i)P(?:[UDA][-+\d;]|E[<=>:7?-\xff])")


def kind_of(data: bytes) -> str:
    """Term of the catalogue that says what the bytes of a file are; empty where nothing is certain."""
    head = data[:_LOOKED_AT]
    for term, magic in _MAGIC:
        if re.match(magic, head, re.DOTALL):
            return term
    return next((term for term, holds in _STRUCTURES if holds(head)), "")


def _is_utf16(head: bytes) -> bool:
    """Whether every other byte is 0, as in a text of ASCII characters, and no other byte is a control character."""
    halves = sorted((head[start:_HEAD:2] for start in (0, 1)), key=lambda half: half.count(0))
    letters, zeros = halves
    return len(letters) >= _LEAST_LETTERS and min(letters) >= 0x09 and 2 * zeros.count(0) > len(zeros)


def _is_program(head: bytes) -> bool:
    return bool(_BLOCK.search(head))


def _is_iso(head: bytes) -> bool:
    """Whether most of the lines are words of ISO code, and G codes of paths are among them."""
    if _NUMBERS_OF_BLOCKS.search(head):
        return False  # damaged blocks
    lines = [line for line in _REMARK.sub(b"", head).splitlines() if line.strip()]
    words = [line for line in lines if _ISO_LINE.fullmatch(line)]
    return 2 * len(words) > len(lines) and any(map(_ISO_WORD.search, words))


def _is_hpgl(head: bytes) -> bool:
    """Whether it begins with instructions of two letters, and some of them move a pen."""
    return bool(_HPGL.match(head) and _PEN.search(head))


def _is_toml(head: bytes) -> bool:
    if len(head) == _LOOKED_AT:
        return False
    try:
        return len(tomllib.loads(head.decode("utf-8").replace("\r\n", "\n"))) > 1
    except (ValueError, RecursionError):
        return False


_STRUCTURES: tuple[tuple[str, Callable[[bytes], bool]], ...] = (
    ("kind-utf16", _is_utf16),
    (PROGRAMS[0], _is_program),
    (PROGRAMS[1], _is_iso),
    ("kind-hpgl", _is_hpgl),
    ("kind-toml", _is_toml),
)
