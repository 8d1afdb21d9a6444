"""Bytes of a program file to text: UTF-8 with or without BOM, UTF-16 with BOM, else GBK as Chinese CAMs write it."""

import codecs

from parser.errors import ProgramError

_BOMS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)

# Full-width forms U+FF01..U+FF5E are ASCII + 0xFEE0 (Unicode, Halfwidth and Fullwidth Forms); one character each, so
# places in the folded text are places in the file.
_NARROW = {code: code - 0xFEE0 for code in range(0xFF01, 0xFF5F)} | {0x3000: 0x20, 0xA0: 0x20}


def decode_text(data: bytes) -> tuple[str, str]:
    """Text of a program file and the name of its encoding.

    Raises ProgramError (3B100) for an empty file and for bytes that are no text.
    """
    if not data.strip():
        raise ProgramError("the file is empty; expected a 3B program; the machine would do nothing", code="3B100")
    text, encoding = _decoded(data)
    # No text holds these; pictures, archives and office files do.
    if any(control in text for control in "\0\1\2\3\4\5\6\x0e\x0f"):
        raise _not_text()
    return text, encoding


def narrow(text: str) -> str:
    """Full-width letters, digits and signs folded to ASCII, character for character."""
    return text if text.isascii() else text.translate(_NARROW)


def printable(text: str) -> str:
    """Text for people: control characters and bytes that were no text become U+FFFD, tabs a blank."""
    if text.isprintable():
        return text
    return "".join(char if char.isprintable() else " " if char == "\t" else "\ufffd" for char in text)


def _decoded(data: bytes) -> tuple[str, str]:
    for bom, encoding in _BOMS:
        if data.startswith(bom):
            try:
                return data.decode(encoding), encoding
            except UnicodeDecodeError:
                raise _not_text() from None
    # GB18030 holds all of GBK and GB2312; an 8-bit remark of any other code page still leaves the ASCII blocks intact.
    for encoding in ("utf-8", "gb18030"):
        try:
            return data.decode(encoding), encoding
        except UnicodeDecodeError:
            continue
    return data.decode("latin-1"), "latin-1"


def _not_text() -> ProgramError:
    return ProgramError("the file is not a text; expected a 3B program; the machine could not load it", code="3B100")
