"""Bytes of a program file to text and back: UTF-8, UTF-16 with BOM, GBK or Big5 as Chinese CAMs write them."""

import codecs
import re
import unicodedata
from typing import Final

from parser.files.kinds import HINTS
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding

REPLACED: Final = "\ufffd"
"""What stands for a character that is no text for people."""

_BOMS = {"utf-8-sig": codecs.BOM_UTF8, "utf-16-le": codecs.BOM_UTF16_LE, "utf-16-be": codecs.BOM_UTF16_BE}

# Full-width forms U+FF01..U+FF5E are ASCII + 0xFEE0 (Unicode, Halfwidth and Fullwidth Forms); one character each, so
# places in the folded text are places in the file.
_NARROW = {code: code - 0xFEE0 for code in range(0xFF01, 0xFF5F)} | {0x3000: 0x20, 0xA0: 0x20}

# Two-byte characters, and of them those that each code set gives its common characters: GB 2312 level 1 (rows 16-55)
# and Big5 level 1 (0xA440-0xC67E), with the punctuation of either.
_PAIR = re.compile(rb"[\x81-\xfe][\x40-\x7e\x80-\xfe]")
_COMMON = {
    "gb18030": re.compile(rb"[\xa1\xa3\xb0-\xd7][\xa1-\xfe]"),
    "big5": re.compile(rb"[\xa1\xa2\xa4-\xc6][\x40-\x7e\xa1-\xfe]"),
}


def decode_text(data: bytes) -> tuple[str, str]:
    """Text of a program file and the name of its encoding; `encode_text` gives the same bytes back.

    Raises ProgramError (3B100) for an empty file and for bytes that are no text.
    """
    if not data.strip():
        raise ProgramError(no_program("empty"))
    text, encoding = _decoded(data)
    if not text:  # a byte order mark alone
        raise ProgramError(no_program("empty"))
    # No text holds these, but for NULs that fill its last sector; pictures, archives and office files do.
    if any(control in text.rstrip("\0") for control in "\0\1\2\3\4\5\6\x0e\x0f"):
        raise ProgramError(no_program("not-text"))
    return text, encoding


def encode_text(text: str, encoding: str) -> bytes:
    """Bytes of a text in an encoding that `decode_text` named, with the BOM that it stood behind."""
    bom = _BOMS.get(encoding, b"")
    return bom + text.encode(encoding.removesuffix("-sig"))


def no_program(what: str, detail: str = "", *, language: str = "3B") -> Finding:
    """Finding 3B100, of ``ISO`` ISO100, of ``PMAC`` PMC100; `what` is a term, `detail` says more in any language."""
    values = {"what": what, "detail": detail, "hint": HINTS.get(what, "hint-program")}
    if language == "PMAC":
        return Finding("PMC100", values)
    return Finding("ISO100", values) if language == "ISO" else Finding("3B100", values)


def narrow(text: str) -> str:
    """Full-width letters, digits and signs folded to ASCII, character for character."""
    return text if text.isascii() else text.translate(_NARROW)


def printable(text: str) -> str:
    """Text for people: what is none becomes U+FFFD, character for character, tabs a blank; blanks of any width stay.

    None are controls, line ends, marks that turn the direction of text, and bytes that were no text.
    """
    if text.isprintable():
        return text
    return "".join(_shown(char) for char in text)


def _shown(char: str) -> str:
    if char.isprintable() or unicodedata.category(char) == "Zs":
        return char
    return " " if char == "\t" else REPLACED


def _decoded(data: bytes) -> tuple[str, str]:
    for encoding, bom in _BOMS.items():
        if data.startswith(bom):
            text = _if_lossless(data, encoding)
            if text is None:
                raise ProgramError(no_program("not-text"))
            return text, encoding
    # GB18030 holds all of GBK and GB 2312; an 8-bit remark of any other code page still leaves the ASCII blocks intact.
    for encoding in ("utf-8", *_by_common_characters(data)):
        text = _if_lossless(data, encoding)
        if text is not None:
            return text, encoding
    return data.decode("latin-1"), "latin-1"


def _if_lossless(data: bytes, encoding: str) -> str | None:
    """Text whose bytes are `data` again; None where the encoding does not fit or writes some character otherwise."""
    try:
        text = data[len(_BOMS.get(encoding, b"")) :].decode(encoding.removesuffix("-sig"))
        return text if encoding == "utf-8" or encode_text(text, encoding) == data else None
    except UnicodeError:
        return None


def _by_common_characters(data: bytes) -> list[str]:
    """GBK and Big5, first the one in which more of the text would be common characters."""
    pairs = _PAIR.findall(data[:65536])
    share = {name: sum(map(bool, map(common.fullmatch, pairs))) for name, common in _COMMON.items()}
    return sorted(_COMMON, key=lambda name: -share[name])
