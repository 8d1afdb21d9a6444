"""Bytes of a program file to text and back: UTF-8, UTF-16 with BOM, GBK or Big5 as Chinese CAMs write them.

Lines that a terminal shows and a build server logs, and neither obeys: what is no text, and commands of CI systems.

What is made harmless, each character by one U+FFFD, so that places in a line stay:

* what is no text for people, as `printable` has it: escape sequences lose their ESC, lines cannot run backwards;
* ``##name[``, anywhere: Azure's agent looks for ``##vso[`` in the whole line, GitHub's runner for ``##[``
  (actions/runner, src/Runner.Common/ActionCommand.cs: TryParse), TeamCity for ``##teamcity[``;
* ``::`` at the start of a line, behind blanks (the same file, TryParseV2: it trims them), and inside where the name of
  a command of GitHub follows and ``::`` comes after it;
* ``section_start:1:`` and ``section_end:1:``, which GitLab takes for the borders of a section
  (lib/gitlab/ci/ansi2json/converter.rb).

The first two compare as people read (.NET, StringComparison.CurrentCulture): characters without a width or a weight do
not count, so that they may stand between the signs.
"""

import codecs
import re
import unicodedata
from collections.abc import Callable
from typing import Final

from parser.files import HINTS
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

# Characters that UTF-8 writes in two bytes, U+0080 to U+07FF, and none in more; and two of them side by side, or one
# that is no sign or letter of Western Europe (U+00A0 to U+00FF).
_OF_TWO = re.compile(rb"[\xc2-\xdf][\x80-\xbf]")
_IN_TWO_BYTES = re.compile(rb"(?:[\x00-\x7f]|[\xc2-\xdf][\x80-\xbf])*+")
_BY_TWO = re.compile(rb"(?:[\xc2-\xdf][\x80-\xbf]){2}|[\xc4-\xdf][\x80-\xbf]")


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


def written_end(text: str) -> int:
    """Where what is written ends: DOS ends a text with ^Z, and fills its last sector with NUL."""
    return len(text.rstrip("\x1a\0"))


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
    return "".join(_printable_sign(char) for char in text)


def _printable_sign(char: str) -> str:
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
    for encoding in (*_by_accident_utf_8(data), "utf-8", *_by_common_characters(data)):
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


def _by_accident_utf_8(data: bytes) -> list[str]:
    """GBK, where UTF-8 fits by accident: the word for a punch, CD B9 C4 A3, is two of its characters, too.

    UTF-8 has all Chinese characters in three bytes. Where it finds none but characters in two, and GBK finds common
    ones alone, it is GBK; signs and letters of Western remarks, such as ± and è, stand alone between others.
    """
    if data.isascii() or not _IN_TWO_BYTES.fullmatch(data) or not _BY_TWO.search(data):
        return []
    return ["gb18030"] if all(map(_COMMON["gb18030"].fullmatch, _OF_TWO.findall(data))) else []


def _by_common_characters(data: bytes) -> list[str]:
    """GBK and Big5, first the one in which more of the text would be common characters."""
    pairs = _PAIR.findall(data[:65536])
    share = {name: sum(map(bool, map(common.fullmatch, pairs))) for name, common in _COMMON.items()}
    return sorted(_COMMON, key=lambda name: -share[name])


# Default_Ignorable_Code_Point (Unicode 15, DerivedCoreProperties.txt), of which `printable` leaves these.
_UNSEEN: Final = "".join(
    f"\\U{first:08x}-\\U{last:08x}"
    for first, last in (
        *((0x34F, 0x34F), (0x115F, 0x1160), (0x17B4, 0x17B5), (0x180B, 0x180D), (0x180F, 0x180F), (0x3164, 0x3164)),
        *((0xFE00, 0xFE0F), (0xFFA0, 0xFFA0), (0xE0100, 0xE01EF)),
    )
)
# docs.github.com, "Workflow commands", and actions/runner, src/Runner.Worker/ActionCommandManager.cs.
_GITHUB: Final = (
    "add-mask|add-matcher|add-path|debug|echo|endgroup|error|group|internal-set-repo-path|notice|remove-matcher|"
    "save-state|set-env|set-output|stop-commands|warning"
)
_COMMAND: Final = re.compile(
    rf"""
      \#(?=[{_UNSEEN}]*\#[\w.{_UNSEEN}-]*\[)
    | (?:(?<=section_start)|(?<=section_end)):(?=[{_UNSEEN}]*\d)
    | :(?=:(?:{_GITHUB})(?:\s(?:[^:]|:(?!:))*+)?::)
    """,
    re.VERBOSE | re.IGNORECASE,
)
_AT_START: Final = re.compile(rf"([\s{_UNSEEN}]*):(?=[{_UNSEEN}]*:)")


def harmless(line: str) -> str:
    """A line as it may be shown to people and logged; it has as many characters as before.

    A line feed is no part of a line: it becomes U+FFFD like all other controls.
    """
    safe = printable(line)
    if ":" not in safe and "#" not in safe:
        return safe
    return _COMMAND.sub(REPLACED, _AT_START.sub(rf"\1{REPLACED}", safe, count=1) if _AT_START.match(safe) else safe)


def escaped(text: str, escape: Callable[[str], str]) -> str:
    """Lines of a data format, in which `escape` writes what `harmless` would take away: the data stay what they are."""
    return "\n".join(_escaped(line, escape) for line in text.split("\n"))


def _escaped(line: str, escape: Callable[[str], str]) -> str:
    safe = harmless(line)
    if safe == line:
        return line
    return "".join(char if char == safe_char else escape(char) for char, safe_char in zip(line, safe, strict=True))
