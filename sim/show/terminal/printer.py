"""The one printer: every line that a command prints passes here, with its colours, and is made harmless.

Colours on a terminal: which there are, and texts with them, told from escape sequences that a file holds.

`parser.text.encoding` has the rule. Text for people is shown without what is harmful in it; formats for machines keep
their data, in escapes of their own. Our own colours go to terminals. What libraries print passes `Cleaned`.
"""

import os
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Final, Literal, NamedTuple, TextIO

import click

from parser.findings.codes import Severity
from parser.text.encoding import escaped, harmless
from sim.show.terminal.streams import outlet

COLOURS: Final[Mapping[str, str]] = {
    Severity.ERROR: "red",
    Severity.WARNING: "yellow",
    Severity.NOTE: "cyan",
    "pass": "green",
    "fail": "red",
    "incomplete": "yellow",
    "to-check": "yellow",
}
_CODES: Final = {"bold": "1", "dim": "2", "red": "31", "green": "32", "yellow": "33", "cyan": "36"}  # ECMA-48, SGR
# A mark that no file can hold: it is drawn when the process starts, and the printer takes it out of each line.
_MARK: Final = f"\x1b{os.urandom(8).hex()}"
_MARKED: Final = re.compile(rf"{_MARK}\[([\d;]*)m")


class Span(NamedTuple):
    """A part of a line, and the codes of its colours for a terminal, such as ``1;31``; empty for none."""

    text: str
    codes: str


def styled(text: str, style: str) -> str:
    """A text in a style, such as ``bold red``, for the printer alone to write. KeyError for a style that is none."""
    codes = ";".join(_CODES[part] for part in style.split())
    return f"{_MARK}[{codes}m{text}{_MARK}[m" if codes else text


def spans(line: str) -> list[Span]:
    """The parts of a line by their styles."""
    parts = _MARKED.split(line)
    return [Span(text, codes) for text, codes in zip(parts[::2], ["", *parts[1::2]], strict=True) if text]


def painted(parts: Iterable[tuple[str, str]], severity: Severity) -> str:
    """A line of a finding in colours, from its parts and what each of them is (sim.show.terminal.finding)."""
    styles = {"place": "bold", "severity": f"bold {COLOURS[severity]}"}
    return "".join(styled(text, styles.get(role, "")) for text, role in parts)


Form = Literal["text", "json", "xml", "github"]
"""What is printed: lines for people, JSON, XML, or workflow commands of GitHub Actions, one a line."""

# Tabs, what fills the last sector of a file of DOS and ends it, and the BOM.
_QUIET: Final = str.maketrans({"\t": " ", "\0": None, "\x1a": None, "\ufeff": None})
# Such a command up to its message; it has no colon but in its ends (sim.show.findings.github).
_OWN_COMMAND: Final = re.compile(r"(::(?:error|warning|notice) [^:]*::)(.*)")


def say(line: str, *, err: bool = False) -> None:
    """Print one line for people; a line feed in it is a character like others that are no text."""
    _print(_shown_line(line, colour=coloured(outlet(err=err))), err=err)


def write(text: str, form: Form = "text", *, err: bool = False) -> None:
    """Print whole lines."""
    _print(printed_text(text, form, colour=coloured(outlet(err=err))), err=err, ends=False)


def clear() -> None:
    """Clear the screen, where stdout is one."""
    if moves_cursor(outlet()):
        _print("\x1b[2J\x1b[1;1H", err=False, ends=False)


def write_exactly(data: bytes, text: str) -> bool:
    """Print bytes to stdout, if there is nothing harmful in the text of which they are made; whether there was not."""
    if any(harmless(line) != line for line in re.split("[\r\n]", text.translate(_QUIET))):
        return False
    stream = outlet()
    stream.flush()
    stream.buffer.write(data)
    stream.flush()
    return True


def printed_text(text: str, form: Form, *, colour: bool = False) -> str:
    """Lines as they are printed, for a file that may be shown or logged later; with our own colours where asked for."""
    if form == "text":
        return "\n".join(_shown_line(line, colour=colour) for line in text.split("\n"))
    return _FORMS[form](text)


def coloured(stream: TextIO) -> bool:
    """Whether a stream gets colours: a terminal does, but a dumb one; NO_COLOR and FORCE_COLOR say otherwise."""
    if os.environ.get("NO_COLOR"):
        return False
    return bool(os.environ.get("FORCE_COLOR")) or moves_cursor(stream)


def moves_cursor(stream: TextIO) -> bool:
    """Whether a stream is a terminal that knows escape sequences."""
    return stream.isatty() and os.environ.get("TERM", "") not in {"dumb", "unknown"}


def _shown_line(line: str, *, colour: bool) -> str:
    """A line for people, with our own colours or without."""
    parts = spans(line)
    text = harmless("".join(part.text for part in parts))
    if not colour:
        return text
    coded, at = [], 0
    for part in parts:
        past = at + len(part.text)
        coded.append(f"\x1b[{part.codes}m{text[at:past]}\x1b[0m" if part.codes else text[at:past])
        at = past
    return "".join(coded)


def _json(text: str) -> str:
    return escaped(text, _in_json)


def _in_json(char: str) -> str:
    units = char.encode("utf-16-be", "surrogatepass")
    return "".join(f"\\u{units[at : at + 2].hex()}" for at in range(0, len(units), 2))


def _xml(text: str) -> str:
    return escaped(text, lambda char: f"&#{ord(char)};")


def _github(text: str) -> str:
    return "\n".join(map(_command, text.split("\n")))


def _command(line: str) -> str:
    own = _OWN_COMMAND.fullmatch(line)
    return f"::{harmless(own[1][2:-2])}::{harmless(own[2])}" if own else harmless(line)


_FORMS: Final[Mapping[str, Callable[[str], str]]] = {"json": _json, "xml": _xml, "github": _github}


def _print(text: str, *, err: bool, ends: bool = True) -> None:
    click.echo(text, file=outlet(err=err), nl=ends, color=True)
